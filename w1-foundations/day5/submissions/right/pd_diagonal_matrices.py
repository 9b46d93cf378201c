# task 5.1: passed
# Gains as matrices.
import numpy as np


def pd_torque(e, ed, kp, kd):
    return np.diag(np.broadcast_to(kp, 7)) @ e + np.diag(np.broadcast_to(kd, 7)) @ ed
