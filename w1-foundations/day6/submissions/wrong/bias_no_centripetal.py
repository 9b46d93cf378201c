# task 6.2: no-centripetal
# alpha x p, but not omega x velocity.
import numpy as np

from robo47.screws import ad


def site_bias(J_space, qd, p):
    V, A = np.zeros(6), np.zeros(6)
    for S, speed in zip(J_space.T, qd):
        V = V + S * speed
        A = A + ad(V) @ S * speed
    return np.append(A[:3], A[3:] + np.cross(A[:3], p))
