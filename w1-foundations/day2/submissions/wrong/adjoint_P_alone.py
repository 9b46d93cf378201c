# task 2.7: lever-arm-not-turned
# [p] alone.
import numpy as np


def skew(w):
    return np.array([[0, -w[2], w[1]], [w[2], 0, -w[0]], [-w[1], w[0], 0]])


def adjoint(T):
    R, P = T[:3, :3], skew(T[:3, 3])
    return np.block([[R, np.zeros((3, 3))], [P, R]])
