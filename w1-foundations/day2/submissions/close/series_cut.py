# task 2.2: rounded-somewhere
# The series to the sixteenth term.
import numpy as np


def skew(w):
    return np.array([[0, -w[2], w[1]], [w[2], 0, -w[0]], [-w[1], w[0], 0]])


def exp_rotation(axis, theta):
    A = skew(axis) * theta
    out, term = np.eye(3), np.eye(3)
    for k in range(1, 17):
        term = term @ A / k
        out = out + term
    return out
