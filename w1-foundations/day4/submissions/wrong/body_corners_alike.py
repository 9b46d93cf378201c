# task 4.1: corners-alike
# m [c] in both corners.
import numpy as np

from robo47.screws import skew


def spatial_inertia(m, c, I):
    C = skew(c)
    return np.block([[I + m * C @ C.T, m * C], [m * C, m * np.eye(3)]])
