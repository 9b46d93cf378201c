# task 46.2: does-not-load
# A bracket is never closed.
import numpy as np


def cross(a, b):
    return np.cross(a, b
