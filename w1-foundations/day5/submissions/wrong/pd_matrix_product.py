# task 5.1: shape
# @ for *: one number.
import numpy as np


def pd_torque(e, ed, kp, kd):
    return kp @ e + kd @ ed
