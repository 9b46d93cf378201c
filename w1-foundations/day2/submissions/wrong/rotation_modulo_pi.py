# task 2.2: rotation-off
# The angle is brought between -90 and 90 degrees.
import numpy as np


def exp_rotation(axis, theta):
    K, theta = np.cross(np.eye(3), axis), (theta + np.pi / 2) % np.pi - np.pi / 2
    return np.eye(3) + np.sin(theta) * K + (1 - np.cos(theta)) * K @ K
