# task 2.9: a-sign
# The minus of row 5 taken for a slip of the pen.
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
    for i, theta in enumerate(np.append(q, 0)):
        alpha, a, d = table[i]
        T = T @ dh_link(alpha, -a if i == 4 else a, d, theta)
    return T
