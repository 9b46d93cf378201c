# task 2.1: pair-of-signs
# y with the signs of x and z.
import numpy as np


def skew(w):
    x, y, z = w
    return np.array([[0, -z, -y], [z, 0, -x], [y, x, 0]])
