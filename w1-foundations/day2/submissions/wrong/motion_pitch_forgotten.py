# task 2.4: pitch-forgotten
# By a point of the axis, as for plain hinges.
import numpy as np


def skew(w):
    return np.array([[0, -w[2], w[1]], [w[2], 0, -w[0]], [-w[1], w[0], 0]])


def exp_screw(S, theta):
    omega, v = S[:3], S[3:]
    K = skew(omega)
    R = np.eye(3) + np.sin(theta) * K + (1 - np.cos(theta)) * K @ K
    T = np.eye(4)
    T[:3, :3] = R
    T[:3, 3] = (np.eye(3) - R) @ np.cross(omega, v) if omega.any() else theta * v
    return T
