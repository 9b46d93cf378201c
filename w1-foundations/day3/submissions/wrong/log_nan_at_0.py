# task 3.3: nan-at-0
# 0 / 0 at the identity.
import numpy as np


def log_rotation(R: np.ndarray) -> np.ndarray:
    a = np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]]) / 2
    sine, cosine = np.linalg.norm(a), (np.trace(R) - 1) / 2
    angle = np.arctan2(sine, cosine)
    if cosine > -0.9:
        return a * (angle / sine)
    B = (R + R.T) / 2 - cosine * np.eye(3)  # (1 - cosine) axis axis^T
    column = B[:, np.argmax(np.diag(B))]
    axis = column / np.linalg.norm(column)
    return angle * axis * (-1.0 if a @ axis < 0 else 1.0)
