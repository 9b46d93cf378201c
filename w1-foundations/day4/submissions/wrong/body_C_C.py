# task 4.1: parallel-axis-sign
# [c] [c] for [c] [c]^T.
import numpy as np

from robo47.screws import skew


def spatial_inertia(m, c, I):
    C = skew(c)
    return np.block([[I + m * C @ C, m * C], [m * C.T, m * np.eye(3)]])
