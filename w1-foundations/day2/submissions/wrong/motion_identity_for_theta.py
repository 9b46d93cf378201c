# task 2.4: identity-for-theta
# I for theta I.
import numpy as np


def skew(w):
    return np.array([[0, -w[2], w[1]], [w[2], 0, -w[0]], [-w[1], w[0], 0]])


def exp_screw(S, theta):
    K, v = skew(S[:3]), S[3:]
    c, s = np.cos(theta), np.sin(theta)
    R = np.eye(3) + s * K + (1 - c) * K @ K
    T = np.eye(4)
    T[:3, :3] = R
    T[:3, 3] = (np.eye(3) + (1 - c) * K + (theta - s) * K @ K) @ v
    return T
