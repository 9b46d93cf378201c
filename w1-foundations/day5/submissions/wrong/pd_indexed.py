# task 5.1: one-number-as-gain
# kp[i], which one number does not have.
import numpy as np


def pd_torque(e, ed, kp, kd):
    return np.array([kp[i] * e[i] + kd[i] * ed[i] for i in range(7)])
