# task 2.2: always-about-z
# Day 1's Rz, whatever the axis.
import numpy as np


def exp_rotation(axis, theta):
    c, s = np.cos(theta), np.sin(theta)
    return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
