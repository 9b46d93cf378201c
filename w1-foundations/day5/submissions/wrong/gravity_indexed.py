# task 5.4: one-number-as-gain
# kp[i], which one number does not have.
import numpy as np


def gravity_pd(e, ed, kp, kd, g_at_q):
    return np.array([kp[i] * e[i] + kd[i] * ed[i] + g_at_q[i] for i in range(7)])


def pd_equilibrium_step(q_goal, g_at_q, kp):
    return q_goal - g_at_q / kp
