# task 4.1: products-of-inertia-sign
# Minus in front of Ixy, Ixz and Iyz, which have it already.
import numpy as np

from robo47.screws import skew


def spatial_inertia(m, c, I):
    C = skew(c)
    own = 2 * np.diag(np.diag(I)) - I
    return np.block([[own + m * C @ C.T, m * C], [m * C.T, m * np.eye(3)]])
