# task 2.1: letters-swapped
# x and z in each other's place.
import numpy as np


def skew(w):
    a, b, c = w[::-1]
    return np.array([[0, -c, b], [c, 0, -a], [-b, a, 0]])
