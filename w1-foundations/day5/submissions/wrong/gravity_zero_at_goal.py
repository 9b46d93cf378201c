# task 5.5: nothing-at-the-goal
# Nothing to do at the goal.
import numpy as np


def gravity_pd(e, ed, kp, kd, g_at_q):
    if not np.any(e):
        return np.zeros(7)
    return kp * e + kd * ed + g_at_q
