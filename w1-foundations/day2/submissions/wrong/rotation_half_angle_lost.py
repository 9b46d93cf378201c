# task 2.2: slip-factor
# 1 - cos as twice the squared sine, but of the whole angle.
import numpy as np


def exp_rotation(axis, theta):
    K = np.cross(np.eye(3), axis)
    return np.eye(3) + np.sin(theta) * K + 2 * np.sin(theta) ** 2 * K @ K
