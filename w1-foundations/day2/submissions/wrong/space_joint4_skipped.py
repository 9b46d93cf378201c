# task 2.6: joint-skipped
# joint4 left out.
import numpy as np


def skew(w):
    return np.array([[0, -w[2], w[1]], [w[2], 0, -w[0]], [-w[1], w[0], 0]])


def exp_screw(S, theta):
    K = skew(S[:3])
    T = np.eye(4)
    T[:3, :3] = np.eye(3) + np.sin(theta) * K + (1 - np.cos(theta)) * K @ K
    G = theta * np.eye(3) + (1 - np.cos(theta)) * K + (theta - np.sin(theta)) * K @ K
    T[:3, 3] = G @ S[3:]
    return T


def fk_space(screws, M, q):
    T = np.eye(4)
    for i in (0, 1, 2, 4, 5, 6):
        T = T @ exp_screw(screws[i], q[i])
    return T @ M
