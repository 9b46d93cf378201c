# task 1.2: few-entries-off
# The sine from the cosine: sqrt forgets its sign. Right for half of the angles.
import numpy as np


def Rz(theta):
    c = np.cos(theta)
    s = np.sqrt(1 - c * c)
    return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
