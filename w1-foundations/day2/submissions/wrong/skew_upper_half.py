# task 2.1: half-empty
# The lower half was to follow.
import numpy as np


def skew(w):
    K = np.zeros((3, 3))
    K[0, 1], K[0, 2], K[1, 2] = -w[2], w[1], -w[0]
    return K
