# task 2.9: passed
# The other convention, with its own rows: alpha and a one row earlier.
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


def _standard(alpha, a, d, theta):
    ca, sa, c, s = np.cos(alpha), np.sin(alpha), np.cos(theta), np.sin(theta)
    return np.array(
        [
            [c, -s * ca, s * sa, a * c],
            [s, c * ca, -c * sa, a * s],
            [0, sa, ca, d],
            [0, 0, 0, 1],
        ]
    )


def dh_fk(table, q):
    T = dh_link(table[0, 0], table[0, 1], 0.0, 0.0)
    alpha = np.append(table[1:, 0], 0.0)
    a = np.append(table[1:, 1], 0.0)
    for i, theta in enumerate(np.append(q, 0.0)):
        T = T @ _standard(alpha[i], a[i], table[i, 2], theta)
    return T
