# task 3.3: arccosine
# The angle comes from an arccosine, cut off at 1.
import numpy as np


def log_rotation(R):
    s = 0.5 * np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]])
    c = 0.5 * (np.trace(R) - 1.0)
    n = np.linalg.norm(s)
    theta = np.arctan2(n, c)
    theta = np.arccos(np.clip(c, -1, 1))
    if c > 0:
        return s if n < 1e-12 else s * theta / n
    A = 0.5 * (R + R.T) - c * np.eye(3)
    i = np.argmax(np.diag(A))
    a = A[:, i] / np.linalg.norm(A[:, i])
    return theta * (-a if a @ s < 0 else a)
