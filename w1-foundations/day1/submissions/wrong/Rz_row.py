# task 1.2: few-entries-off
# The first row holds c and s as they come: a slip, not a mistake with a name.
import numpy as np


def Rz(theta):
    c, s = np.cos(theta), np.sin(theta)
    return np.array([[s, -s, 0], [s, c, 0], [0, 0, 1]])
