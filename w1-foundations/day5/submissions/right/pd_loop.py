# task 5.1: passed
# A loop over the joints.
import numpy as np


def pd_torque(e, ed, kp, kd):
    kp, kd = np.broadcast_to(kp, 7), np.broadcast_to(kd, 7)
    return np.array([p * x + d * v for p, x, d, v in zip(kp, e, kd, ed)])
