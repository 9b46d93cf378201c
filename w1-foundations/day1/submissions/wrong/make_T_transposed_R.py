# task 1.1: R-transposed
# The rotation is stored by columns.
import numpy as np


def make_T(R, t):
    T = np.eye(4)
    for i in range(3):
        T[:3, i] = R[i]
    T[:3, 3] = t
    return T
