# tasks 2.2 2.4: passed
# The series itself, by squaring.
import numpy as np


def skew(w):
    return np.array([[0, -w[2], w[1]], [w[2], 0, -w[0]], [-w[1], w[0], 0]])


def _expm(A):
    out, term = np.eye(len(A)), np.eye(len(A))
    for k in range(1, 30):
        term = term @ A / (64 * k)
        out = out + term
    for _ in range(6):
        out = out @ out
    return out


def exp_rotation(axis, theta):
    return _expm(skew(axis) * theta)


def exp_screw(S, theta):
    A = np.zeros((4, 4))
    A[:3, :3], A[:3, 3] = skew(S[:3]), S[3:]
    return _expm(A * theta)
