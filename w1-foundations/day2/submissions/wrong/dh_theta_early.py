# task 2.9: theta-one-row-early
# theta of the next row.
import numpy as np


def dh_link(alpha, a, d, theta):
    ca, sa, ct, st = np.cos(alpha), np.sin(alpha), np.cos(theta), np.sin(theta)
    return np.array(
        [
            [ct, -st, 0, a],
            [st * ca, ct * ca, -sa, -sa * d],
            [st * sa, ct * sa, ca, ca * d],
            [0, 0, 0, 1],
        ]
    )


def dh_fk(table, q):
    T = np.eye(4)
    th = np.append(q, 0.0)
    for i in range(8):
        T = T @ dh_link(table[i, 0], table[i, 1], table[i, 2], th[(i + 1) % 8])
    return T
