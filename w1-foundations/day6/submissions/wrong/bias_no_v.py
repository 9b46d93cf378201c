# task 6.2: v-forgotten
# omega x (omega x p), as for a wheel that stands.
import numpy as np

from robo47.screws import ad


def site_bias(J_space, qd, p):
    V, A = np.zeros(6), np.zeros(6)
    for S, speed in zip(J_space.T, qd):
        V = V + S * speed
        A = A + ad(V) @ S * speed
    w = V[:3]
    return np.append(A[:3], A[3:] + np.cross(A[:3], p) + np.cross(w, np.cross(w, p)))
