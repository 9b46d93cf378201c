# task 3.3: zero-for-small-angles
# 0 for all angles under 1e-4.
import numpy as np


def log_rotation(R):
    s = 0.5 * np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]])
    c = 0.5 * (np.trace(R) - 1.0)
    n = np.linalg.norm(s)
    theta = np.arctan2(n, c)
    if n < 1e-4 and c > 0:
        return np.zeros(3)
    if c > 0:
        return s * theta / n
    A = 0.5 * (R + R.T) - c * np.eye(3)
    i = np.argmax(np.diag(A))
    a = A[:, i] / np.linalg.norm(A[:, i])
    return theta * (-a if a @ s < 0 else a)
