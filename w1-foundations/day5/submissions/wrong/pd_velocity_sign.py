# task 5.1: velocity-error-sign
# A damper has a minus, they thought.
import numpy as np


def pd_torque(e, ed, kp, kd):
    return kp * e - kd * ed
