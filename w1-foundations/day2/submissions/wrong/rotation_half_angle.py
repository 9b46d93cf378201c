# task 2.2: half-angle
# As for a quaternion.
import numpy as np


def skew(w):
    return np.array([[0, -w[2], w[1]], [w[2], 0, -w[0]], [-w[1], w[0], 0]])


def exp_rotation(axis, theta):
    K = skew(axis)
    return np.eye(3) + np.sin(theta / 2) * K + (1 - np.cos(theta / 2)) * K @ K
