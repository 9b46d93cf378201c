# task 4.1: distance-counts-twice
# A 2 that belongs to the energy.
import numpy as np

from robo47.screws import skew


def spatial_inertia(m, c, I):
    C = skew(c)
    return np.block([[I + 2 * m * C @ C.T, m * C], [m * C.T, m * np.eye(3)]])
