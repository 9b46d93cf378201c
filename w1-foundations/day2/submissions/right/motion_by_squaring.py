# task 2.4: passed
# The 4x4 exponential: a series for a small part, then squared eight times.
import numpy as np


def exp_screw(S, theta):
    A, T = np.zeros((4, 4)), np.eye(4)
    A[:3, :3], A[:3, 3] = np.cross(np.eye(3), S[:3]), S[3:]
    for k in range(13, 0, -1):
        T = np.eye(4) + A * theta / 256 @ T / k
    return np.linalg.matrix_power(T, 256)
