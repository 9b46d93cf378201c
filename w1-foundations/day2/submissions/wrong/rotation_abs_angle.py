# task 2.2: sign-of-theta-lost
# abs(theta) first.
import numpy as np


def skew(w):
    x, y, z = w
    return np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])


def exp_rotation(axis, theta):
    K = skew(axis)
    theta = abs(theta)
    return np.eye(3) + np.sin(theta) * K + (1 - np.cos(theta)) * K @ K
