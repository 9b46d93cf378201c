# task 5.1: damper-forgotten
# P alone.
import numpy as np


def pd_torque(e, ed, kp, kd):
    return kp * e
