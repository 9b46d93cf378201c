# task 1.2: shape
# The turn of the plane.
import numpy as np


def Rz(theta):
    c, s = np.cos(theta), np.sin(theta)
    return np.array([[c, -s], [s, c]])
