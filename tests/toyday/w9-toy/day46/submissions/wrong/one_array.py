# task 46.2: one-array-for-all
# One array for all calls, written into.
import numpy as np

OUT = np.zeros(3)


def cross(a, b):
    OUT[:] = np.cross(a, b)
    return OUT
