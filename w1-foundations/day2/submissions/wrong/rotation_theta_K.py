# task 2.2: theta-for-sine
# theta K, as in the series.
import numpy as np


def skew(w):
    x, y, z = w
    return np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])


def exp_rotation(axis, theta):
    K = skew(axis)
    return np.eye(3) + theta * K + (1 - np.cos(theta)) * K @ K
