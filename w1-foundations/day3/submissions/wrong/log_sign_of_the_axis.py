# task 3.3: sign-of-the-axis
# An axis from the symmetric part, whatever its sign.
import numpy as np


def log_rotation(R):
    s = 0.5 * np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]])
    c = 0.5 * (np.trace(R) - 1.0)
    n = np.linalg.norm(s)
    if n < 1e-2 and c > 0:
        return s
    A = 0.5 * (R + R.T) - c * np.eye(3)
    a = A[:, np.argmax(np.diag(A))]
    return np.arctan2(n, c) * a / np.linalg.norm(a)
