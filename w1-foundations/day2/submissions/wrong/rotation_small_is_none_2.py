# task 2.2: small-angle-ignored (not in a run: the lab draws hardly any angle so small)
# A case of its own for theta near 0, and a wide one.
import numpy as np


def skew(w):
    x, y, z = w
    return np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])


def exp_rotation(axis, theta):
    if abs(theta) < 1e-2:
        return np.eye(3)
    K = skew(axis)
    return np.eye(3) + np.sin(theta) * K + (1 - np.cos(theta)) * K @ K
