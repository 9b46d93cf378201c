# task 1.1: passed
# Fortran order in memory.
import numpy as np


def make_T(R, t):
    T = np.zeros((4, 4), order="F")
    T.T[:3, :3], T.T[3, :3], T.T[3, 3] = np.transpose(R), t, 1
    return T
