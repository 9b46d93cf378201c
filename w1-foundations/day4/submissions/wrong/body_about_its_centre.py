# task 4.1: parallel-axis-forgotten
# The inertia is about the centre of mass, not about the origin.
import numpy as np

from robo47.screws import skew


def spatial_inertia(m, c, I):
    C = skew(c)
    return np.block([[I, m * C], [m * C.T, m * np.eye(3)]])
