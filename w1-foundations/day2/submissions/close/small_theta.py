# task 2.4: rounded-somewhere
# The velocity summed up in small steps.
import numpy as np


def skew(w):
    return np.array([[0, -w[2], w[1]], [w[2], 0, -w[0]], [-w[1], w[0], 0]])


def exp_screw(S, theta):
    n = 2000
    K, x = skew(S[:3]), (np.arange(n) + 0.5) * theta / n
    T = np.eye(4)
    T[:3, :3] = np.eye(3) + np.sin(theta) * K + (1 - np.cos(theta)) * K @ K
    steps = [np.eye(3) + np.sin(t) * K + (1 - np.cos(t)) * K @ K for t in x]
    T[:3, 3] = np.sum(steps, axis=0) @ S[3:] * theta / n
    return T
