# task 2.9: flange-typed-in (not in a run: the lab has one table)
# The flange's 0.107 m stand in the code.
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
    for (alpha, a, d), t in zip(table[:7], q):
        T = T @ dh_link(alpha, a, d, t)
    return T @ dh_link(0, 0, 0.107, 0)
