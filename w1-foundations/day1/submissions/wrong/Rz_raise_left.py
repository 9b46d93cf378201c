# task 1.2: raise-left-in
# The code is written, and the raise of the starter stands above it.
import numpy as np


def Rz(theta):
    raise NotImplementedError("task 1.2: write Rz")
    c, s = np.cos(theta), np.sin(theta)
    return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
