# task 2.8: M-last
# The world's form again.
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


def fk_body(body_screws, M, q):
    T = np.eye(4)
    for B, theta in zip(body_screws, q):
        T = T @ exp_screw(B, theta)
    return T @ M
