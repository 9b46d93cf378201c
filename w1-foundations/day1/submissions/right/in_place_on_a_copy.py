# tasks 1.3 1.4: passed
# Works inside a copy, in place.
import numpy as np


def inverse(T):
    T = T.copy()
    T[:3, :3] = T[:3, :3].T.copy()
    T[:3, 3] = T[:3, :3] @ T[:3, 3]
    T[:3, 3] *= -1
    return T


def quat_to_R(quat):
    quat = quat.copy()
    quat /= np.linalg.norm(quat)
    w, x, y, z = quat
    R = 2 * np.outer(quat[1:], quat[1:])
    R += (2 * w * w - 1) * np.eye(3)
    R += 2 * w * np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return R
