# task 1.5: R-lost
# The quaternion is never used.
import numpy as np


def link_T(pos, quat):
    T = np.eye(4)
    T[:3, 3] = pos
    return T


def joint_T(q):
    c, s = np.cos(q), np.sin(q)
    return np.array([[c, -s, 0, 0], [s, c, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])
