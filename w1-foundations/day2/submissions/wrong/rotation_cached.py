# task 2.2: kept-between-calls
# Kept by theta, whatever the axis is.
import numpy as np

_cache = {}


def exp_rotation(axis, theta):
    if theta not in _cache:
        K = np.cross(np.eye(3), axis)
        _cache[theta] = np.eye(3) + np.sin(theta) * K + (1 - np.cos(theta)) * K @ K
    return _cache[theta]
