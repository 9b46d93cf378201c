# task 2.4: sign-of-the-point
# The book's other form, with v x omega.
import numpy as np


def skew(w):
    x, y, z = w
    return np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])


def exp_rotation(axis, theta):
    K = skew(axis)
    return np.eye(3) + np.sin(theta) * K + (1 - np.cos(theta)) * K @ K


def exp_screw(S, theta):
    w, v = S[:3], S[3:]
    T = np.eye(4)
    if np.linalg.norm(w) < 1e-9:
        T[:3, 3] = v * theta
        return T
    R = exp_rotation(w, theta)
    T[:3, :3] = R
    T[:3, 3] = (np.eye(3) - R) @ np.cross(v, w) + np.outer(w, w) @ v * theta
    return T
