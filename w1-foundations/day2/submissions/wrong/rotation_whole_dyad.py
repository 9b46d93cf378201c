# task 2.2: dyad-without-factor
# The part along the axis is whole, at every angle.
import numpy as np


def skew(w):
    x, y, z = w
    return np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])


def exp_rotation(axis, theta):
    c, s = np.cos(theta), np.sin(theta)
    return c * np.eye(3) + s * skew(axis) + np.outer(axis, axis)
