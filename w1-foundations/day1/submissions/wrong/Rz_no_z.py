# task 1.2: z-lost
# A 3x3 of zeros, filled in the plane only.
import numpy as np


def Rz(theta):
    c, s = np.cos(theta), np.sin(theta)
    R = np.zeros((3, 3))
    R[:2, :2] = [[c, -s], [s, c]]
    return R
