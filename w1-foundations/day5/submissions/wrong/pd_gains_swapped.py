# task 5.1: gains-swapped
# kd and kp swapped.
import numpy as np


def pd_torque(e, ed, kp, kd):
    return kd * e + kp * ed
