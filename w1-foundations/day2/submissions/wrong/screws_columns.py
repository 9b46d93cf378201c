# task 2.5: shape
# Screws as columns.
import numpy as np


def joint_screws(T_zero):
    rows = [np.r_[T[:3, 2], -np.cross(T[:3, 2], T[:3, 3])] for T in T_zero]
    return np.array(rows).T
