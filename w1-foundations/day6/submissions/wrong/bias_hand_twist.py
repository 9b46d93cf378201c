# task 6.2: twist-of-the-hand
# Every joint with the hand's own twist.
import numpy as np

from robo47.screws import ad


def bias_acceleration(J_space, qd, p):
    V = J_space @ qd
    A = sum(ad(V) @ S * speed for S, speed in zip(J_space.T, qd))
    v = V[3:] + np.cross(V[:3], p)
    return np.append(A[:3], A[3:] + np.cross(A[:3], p) + np.cross(V[:3], v))
