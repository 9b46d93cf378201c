# task 6.2: passed
# Every pair of joints, as Christoffel did.
import numpy as np

from robo47.screws import ad


def site_bias(J_space, qd, p):
    A = np.zeros(6)
    for j in range(7):
        for i in range(j):
            A += ad(J_space[:, i]) @ J_space[:, j] * qd[i] * qd[j]
    V = J_space @ qd
    v = V[3:] + np.cross(V[:3], p)
    return np.append(A[:3], A[3:] + np.cross(A[:3], p) + np.cross(V[:3], v))
