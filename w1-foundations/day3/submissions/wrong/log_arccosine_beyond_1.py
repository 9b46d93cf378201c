# task 3.3: arccosine-beyond-1 (not in a run: its identity is exact)
# An arccosine without a cut at 1; the rest is right.
import numpy as np


def log_rotation(R):
    s = 0.5 * np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]])
    c = 0.5 * (np.trace(R) - 1.0)
    n, angle = np.linalg.norm(s), np.arccos(c)
    if c > 0:
        return s * (angle / n if n > 0 else 1.0 + 0.0 * angle)
    A = 0.5 * (R + R.T) - c * np.eye(3)
    a = A[:, np.argmax(np.diag(A))]
    a = a / np.linalg.norm(a)
    return angle * (-a if a @ s < 0 else a)
