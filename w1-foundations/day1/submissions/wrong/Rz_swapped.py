# task 1.2: sin-and-cos-swapped
# c is the sine and s the cosine.
import numpy as np


def Rz(theta):
    c, s = np.sin(theta), np.cos(theta)
    return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
