# task 4.1: one-corner-empty
# The mirror image is forgotten.
import numpy as np

from robo47.screws import skew


def spatial_inertia(m, c, I):
    C = skew(c)
    return np.block([[I + m * C @ C.T, m * C], [np.zeros((3, 3)), m * np.eye(3)]])
