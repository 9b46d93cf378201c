# task 2.1: ones-on-diagonal
# The identity's diagonal is kept.
import numpy as np


def skew(w):
    x, y, z = w
    return np.array([[1, -z, y], [z, 1, -x], [-y, x, 1]])
