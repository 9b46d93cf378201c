# task 2.2: kept-between-calls
# Kept by theta, whatever the axis is.
import numpy as np


def skew(w):
    x, y, z = w
    return np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])


_cache = {}


def exp_rotation(axis, theta):
    if theta not in _cache:
        K = skew(axis)
        _cache[theta] = np.eye(3) + np.sin(theta) * K + (1 - np.cos(theta)) * K @ K
    return _cache[theta]
