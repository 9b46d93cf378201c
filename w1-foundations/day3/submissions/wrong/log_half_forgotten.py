# task 3.3: twice-the-sine-in-atan2
# The half of (R - R^T) / 2 is forgotten, and atan2 gets it.
import numpy as np


def log_rotation(R):
    s = np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]])
    c = 0.5 * (np.trace(R) - 1.0)
    n = np.linalg.norm(s)
    theta = np.arctan2(n, c)
    if c > 0:
        return s if n < 1e-12 else s * theta / n
    A = 0.5 * (R + R.T) - c * np.eye(3)
    i = np.argmax(np.diag(A))
    a = A[:, i] / np.linalg.norm(A[:, i])
    return theta * (-a if a @ s < 0 else a)
