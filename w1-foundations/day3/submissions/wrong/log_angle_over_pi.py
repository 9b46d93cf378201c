# task 3.3: angle-over-pi
# A quaternion whose largest entry is positive; w may be less than 0.
import numpy as np


def log_rotation(R):
    s = 0.5 * np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]])
    c = 0.5 * (np.trace(R) - 1.0)
    n = np.linalg.norm(s)
    if n < 1e-2 and c > 0:
        return s
    A = 0.5 * (R + R.T) - c * np.eye(3)
    a = A[:, np.argmax(np.diag(A))]
    a = a / np.linalg.norm(a)  # one of two; which way round is not asked
    angle = np.arctan2(n, c)
    return (angle if n < 1e-9 or a @ s > 0 else 2 * np.pi - angle) * a
