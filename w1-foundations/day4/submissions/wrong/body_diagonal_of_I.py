# task 4.1: diagonal-of-I
# Three moments, no products.
import numpy as np

from robo47.screws import skew


def spatial_inertia(m, c, I):
    C = skew(c)
    own = np.diag([I[0, 0], I[1, 1], I[2, 2]])
    return np.block([[own + m * C @ C.T, m * C], [m * C.T, m * np.eye(3)]])
