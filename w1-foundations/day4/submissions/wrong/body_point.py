# task 4.1: own-inertia-forgotten
# A point mass: the body's own inertia is not there.
import numpy as np

from robo47.screws import skew


def spatial_inertia(m, c, I):
    C = skew(c)
    return np.block([[m * C @ C.T, m * C], [m * C.T, m * np.eye(3)]])
