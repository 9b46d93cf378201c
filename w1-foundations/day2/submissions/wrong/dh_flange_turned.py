# task 2.9: flange-turned
# The last angle twice.
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
    for i in range(8):
        T = T @ dh_link(*table[i], q[min(i, 6)])
    return T
