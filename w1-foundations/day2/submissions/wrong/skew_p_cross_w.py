# task 2.1: p-cross-w
# The signs of the transposed matrix, from memory.
import numpy as np


def skew(w):
    x, y, z = w
    return np.array([[0, z, -y], [-z, 0, x], [y, -x, 0]])
