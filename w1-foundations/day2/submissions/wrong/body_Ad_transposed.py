# task 2.7: transposed-for-inverse
# The inverse of Ad(M) taken for its transpose.
import numpy as np


def skew(w):
    x, y, z = w
    return np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])


def adjoint(T):
    R, p = T[:3, :3], T[:3, 3]
    return np.block([[R, np.zeros((3, 3))], [skew(p) @ R, R]])


def body_screws(screws, M):
    return (adjoint(M).T @ screws.T).T
