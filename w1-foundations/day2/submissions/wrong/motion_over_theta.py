# task 2.4: travel-over-theta
# The left Jacobian without the factor theta.
import numpy as np


def skew(w):
    x, y, z = w
    return np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])


def exp_rotation(axis, theta):
    K = skew(axis)
    return np.eye(3) + np.sin(theta) * K + (1 - np.cos(theta)) * K @ K


def exp_screw(S, theta):
    w, v = S[:3], S[3:]
    K = skew(w)
    T = np.eye(4)
    if abs(theta) < 1e-12:
        return T
    T[:3, :3] = exp_rotation(w, theta)
    T[:3, 3] = (
        np.eye(3)
        + (1 - np.cos(theta)) / theta * K
        + (theta - np.sin(theta)) / theta * K @ K
    ) @ v
    return T
