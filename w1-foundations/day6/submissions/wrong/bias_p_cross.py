# task 6.2: p-sign
# p x omega for omega x p.
import numpy as np

from robo47.screws import ad


def site_bias(J_space, qd, p):
    V, A = np.zeros(6), np.zeros(6)
    for S, speed in zip(J_space.T, qd):
        V = V + S * speed
        A = A + ad(V) @ S * speed
    v = V[3:] + np.cross(p, V[:3])
    return np.append(A[:3], A[3:] + np.cross(p, A[:3]) + np.cross(V[:3], v))
