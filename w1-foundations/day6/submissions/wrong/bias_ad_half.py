# task 6.2: ad-half
# A bracket without its [v].
import numpy as np


def site_bias(J_space, qd, p):
    V, A = np.zeros(6), np.zeros(6)
    for S, speed in zip(J_space.T, qd):
        V = V + S * speed
        A = A + np.append(np.cross(V[:3], S[:3]), np.cross(V[:3], S[3:])) * speed
    v = V[3:] + np.cross(V[:3], p)
    return np.append(A[:3], A[3:] + np.cross(A[:3], p) + np.cross(V[:3], v))
