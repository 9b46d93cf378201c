# task 2.1: shape
# A cross product instead of a matrix.
import numpy as np


def skew(w):
    return np.cross(w, [1.0, 0.0, 0.0])
