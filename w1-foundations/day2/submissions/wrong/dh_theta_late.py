# task 2.9: theta-one-row-late
# The 0 first.
import numpy as np


def dh_link(alpha, a, d, theta):
    ca, sa, c, s = np.cos(alpha), np.sin(alpha), np.cos(theta), np.sin(theta)
    return np.array(
        [
            [c, -s, 0, a],
            [s * ca, c * ca, -sa, -d * sa],
            [s * sa, c * sa, ca, d * ca],
            [0, 0, 0, 1],
        ]
    )


def dh_fk(table, q):
    T = np.eye(4)
    for (alpha, a, d), theta in zip(table, np.append(0, q)):
        T = T @ dh_link(alpha, a, d, theta)
    return T
