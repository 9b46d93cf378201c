# task 3.4: rotation-in-the-hands-axes
# R^T R_goal: the hand's axes.
import numpy as np


def log_rotation(R: np.ndarray) -> np.ndarray:
    a = np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]]) / 2
    sine, cosine = np.linalg.norm(a), (np.trace(R) - 1) / 2
    angle = np.arctan2(sine, cosine)
    if cosine > -0.9:
        return a * (angle / sine if sine > 0 else 1.0)
    B = (R + R.T) / 2 - cosine * np.eye(3)  # (1 - cosine) axis axis^T
    column = B[:, np.argmax(np.diag(B))]
    axis = column / np.linalg.norm(column)
    return angle * axis * (-1.0 if a @ axis < 0 else 1.0)


def pose_error(T, T_goal):
    rotation = log_rotation(T[:3, :3].T @ T_goal[:3, :3])
    translation = T_goal[:3, 3] - T[:3, 3]
    return np.concatenate([rotation, translation])
