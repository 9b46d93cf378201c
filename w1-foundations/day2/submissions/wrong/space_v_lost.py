# task 2.6: travel-on-a-line
# The exponential written anew, without its bend.
import numpy as np


def skew(w):
    return np.array([[0, -w[2], w[1]], [w[2], 0, -w[0]], [-w[1], w[0], 0]])


def fk_space(screws, M, q):
    T = np.eye(4)
    for S, theta in zip(screws, q):
        K = skew(S[:3])
        step = np.eye(4)
        step[:3, :3] += np.sin(theta) * K + (1 - np.cos(theta)) * K @ K
        step[:3, 3] = theta * S[3:]
        T = T @ step
    return T @ M
