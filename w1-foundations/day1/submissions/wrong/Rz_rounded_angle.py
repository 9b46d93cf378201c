# task 1.2: angle-rounded
# The angle is rounded to two decimals.
import numpy as np


def Rz(theta):
    theta = round(theta, 2)
    c, s = np.cos(theta), np.sin(theta)
    return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
