# task 1.1: t-in-last-row
# Rows taken for columns when the translation is stored.
import numpy as np


def make_T(R, t):
    T = np.eye(4)
    T[:3, :3] = R
    T[3, :3] = t
    return T
