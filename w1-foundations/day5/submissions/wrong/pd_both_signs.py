# task 5.1: all-signs
# Both minus, as in the equation of motion.
import numpy as np


def pd_torque(e, ed, kp, kd):
    return -(kp * e + kd * ed)
