# task 7.6: not-finite
# Divides by the angle, which may be 0.
import numpy as np


def log(R):
    angle = np.arccos(np.clip((np.trace(R) - 1) / 2, -1, 1))
    w = np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]])
    return angle * w / np.linalg.norm(w)


def exp(w):
    angle = np.linalg.norm(w)
    x, y, z = w / angle
    K = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * K + (1 - np.cos(angle)) * K @ K


def interpolate_pose(T0, T1, s):
    R0, R1, p0, p1 = T0[:3, :3], T1[:3, :3], T0[:3, 3], T1[:3, 3]
    T = np.eye(4)
    T[:3, :3] = R0 @ exp(s * log(R0.T @ R1))
    T[:3, 3] = p0 + s * (p1 - p0)
    return T
