# task 2.2: passed
# cos I + sin [a] + (1 - cos) a a^T.
import numpy as np


def skew(w):
    return np.array([[0, -w[2], w[1]], [w[2], 0, -w[0]], [-w[1], w[0], 0]])


def exp_rotation(axis, theta):
    c, s = np.cos(theta), np.sin(theta)
    return c * np.eye(3) + s * skew(axis) + (1 - c) * np.outer(axis, axis)
