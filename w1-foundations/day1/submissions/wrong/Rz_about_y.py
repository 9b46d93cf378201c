# task 1.2: turns-about-y
# The y matrix, with its minus where z's would be, so backwards as well.
import numpy as np


def Rz(theta):
    c, s = np.cos(theta), np.sin(theta)
    return np.array([[c, 0, -s], [0, 1, 0], [s, 0, c]])
