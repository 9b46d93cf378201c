# task 2.9: passed
# Four elementary poses; theta by zip_longest.
from itertools import zip_longest

import numpy as np


def _turn(k, angle):
    T = np.eye(4)
    i, j = (k + 1) % 3, (k + 2) % 3
    T[i, i] = T[j, j] = np.cos(angle)
    T[i, j], T[j, i] = -np.sin(angle), np.sin(angle)
    return T


def _move(k, length):
    T = np.eye(4)
    T[k, 3] = length
    return T


def dh_link(alpha, a, d, theta):
    return _move(0, a) @ _turn(0, alpha) @ _move(2, d) @ _turn(2, theta)


def dh_fk(table, q):
    T = np.eye(4)
    for row, theta in zip_longest(table, q, fillvalue=0.0):
        T = T @ dh_link(*row, theta)
    return T
