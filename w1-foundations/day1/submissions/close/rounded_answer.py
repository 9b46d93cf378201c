# task 1.2: rounded
# Rounded "to get rid of 6e-17".
import numpy as np


def Rz(theta):
    c, s = np.cos(theta), np.sin(theta)
    return np.round([[c, -s, 0], [s, c, 0], [0, 0, 1]], 5)
