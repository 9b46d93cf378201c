# task 1.2: rounded-somewhere
# To degrees and back with two different pis.
import numpy as np


def Rz(theta):
    degrees = theta * 180 / 3.14159
    c, s = np.cos(np.deg2rad(degrees)), np.sin(np.deg2rad(degrees))
    return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
