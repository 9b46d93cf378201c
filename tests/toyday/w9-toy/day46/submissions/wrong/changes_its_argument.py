# task 46.2: argument-changed
# The first vector is normalised in place, and undone too late.
import numpy as np


def cross(a, b):
    c = np.cross(a, b)
    a *= 2.0
    return c
