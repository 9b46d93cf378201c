# task 2.5: moment-sign
# The sign of v, in every screw.
import numpy as np


def joint_screws(T_zero):
    return np.array([np.r_[T[:3, 2], np.cross(T[:3, 2], T[:3, 3])] for T in T_zero])
