# task 4.1: corners-empty
# Turning and moving as if they were independent.
import numpy as np

from robo47.screws import skew


def spatial_inertia(m, c, I):
    C = skew(c)
    return np.block([[I + m * C @ C.T, 0 * C], [0 * C.T, m * np.eye(3)]])
