# task 1.2: radians-taken-for-degrees
# The angle comes in radians and is converted all the same.
import numpy as np


def Rz(theta):
    theta = np.deg2rad(theta)
    c, s = np.cos(theta), np.sin(theta)
    return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
