# task 5.1: rounded
# Rounded to 5 decimals.
import numpy as np


def pd_torque(e, ed, kp, kd):
    return np.round(kp * e + kd * ed, 5)
