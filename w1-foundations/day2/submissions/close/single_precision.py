# task 2.4: float32
# float32 throughout.
import numpy as np


def skew(w):
    return np.array([[0, -w[2], w[1]], [w[2], 0, -w[0]], [-w[1], w[0], 0]])


def exp_screw(S, theta):
    S, theta = S.astype(np.float32), np.float32(theta)
    K = skew(S[:3]).astype(np.float32)
    c, s, I = np.cos(theta), np.sin(theta), np.eye(3, dtype=np.float32)
    T = np.eye(4, dtype=np.float32)
    T[:3, :3] = I + s * K + (1 - c) * K @ K
    T[:3, 3] = (theta * I + (1 - c) * K + (theta - s) * K @ K) @ S[3:]
    return T
