# task 1.2: turns-about-x
# The matrix next to it in the book.
import numpy as np


def Rz(theta):
    c, s = np.cos(theta), np.sin(theta)
    return np.array([[1, 0, 0], [0, c, -s], [0, s, c]])
