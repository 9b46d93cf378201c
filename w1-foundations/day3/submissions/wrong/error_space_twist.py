# task 3.4: space-twist
# The twist log(T_goal T^-1).
import numpy as np

from robo47.screws import skew


def log_rotation(R):
    s = 0.5 * np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]])
    c = 0.5 * (np.trace(R) - 1.0)
    n = np.linalg.norm(s)
    theta = np.arctan2(n, c)
    if c > 0:
        return s if n < 1e-12 else s * theta / n
    B = 0.5 * (R + R.T)
    A = (B - c * np.eye(3)) / (1 - c)
    i = np.argmax(np.diag(A))
    axis = A[:, i] / np.linalg.norm(A[:, i])
    if axis @ s < 0:
        axis = -axis
    elif n < 1e-15 and axis[np.argmax(np.abs(axis))] < 0:
        axis = -axis
    return theta * axis


def pose_error(T, T_goal):
    D = T_goal @ np.linalg.inv(T)
    w = log_rotation(D[:3, :3])
    th = np.linalg.norm(w)
    if th < 1e-9:
        return np.hstack([w, D[:3, 3]])
    K = skew(w / th)
    G = np.eye(3) / th - K / 2 + (1 / th - 0.5 / np.tan(th / 2)) * K @ K
    return np.hstack([w, th * G @ D[:3, 3]])
