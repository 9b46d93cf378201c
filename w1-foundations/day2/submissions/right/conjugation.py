# task 2.4: passed
# Two moves and a turn about a line through the origin.
import numpy as np


def skew(w):
    return np.array([[0, -w[2], w[1]], [w[2], 0, -w[0]], [-w[1], w[0], 0]])


def exp_screw(S, theta):
    omega, v = S[:3], S[3:]
    if not np.any(omega):
        T = np.eye(4)
        T[:3, 3] = theta * v
        return T
    point, pitch = np.cross(omega, v), omega @ v
    there, turn, back = np.eye(4), np.eye(4), np.eye(4)
    there[:3, 3], back[:3, 3] = point, -point
    K = skew(omega)
    turn[:3, :3] += np.sin(theta) * K + (1 - np.cos(theta)) * K @ K
    turn[:3, 3] = pitch * theta * omega
    return there @ turn @ back
