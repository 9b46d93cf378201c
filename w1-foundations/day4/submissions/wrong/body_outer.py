# task 4.1: outer-product-for-skew
# c c^T for [c] [c]^T.
import numpy as np

from robo47.screws import skew


def spatial_inertia(m, c, I):
    C = skew(c)
    return np.block([[I + m * np.outer(c, c), m * C], [m * C.T, m * np.eye(3)]])
