# task 5.1: error-in-degrees
# Degrees, since 0.1 looked small.
import numpy as np


def pd_torque(e, ed, kp, kd):
    return kp * np.degrees(e) + kd * ed
