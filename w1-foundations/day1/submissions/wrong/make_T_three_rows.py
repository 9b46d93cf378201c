# task 1.1: shape
# [R | t] without the bottom row.
import numpy as np


def make_T(R, t):
    return np.hstack([R, np.reshape(t, (3, 1))])
