# task 5.1: velocity-error-forgotten
# kd without ed.
import numpy as np


def pd_torque(e, ed, kp, kd):
    return kp * e + kd
