# task 5.1: error-sign
# q - q_ref in mind.
import numpy as np


def pd_torque(e, ed, kp, kd):
    return kd * ed - kp * e
