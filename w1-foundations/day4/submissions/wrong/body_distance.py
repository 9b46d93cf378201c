# task 4.1: distance-in-all-directions
# The parallel axis theorem of school: m d^2, for all axes.
import numpy as np

from robo47.screws import skew


def spatial_inertia(m, c, I):
    C = skew(c)
    return np.block([[I + m * (c @ c) * np.eye(3), m * C], [m * C.T, m * np.eye(3)]])
