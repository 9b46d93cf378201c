# task 3.3: passed
# The unit quaternion, from the largest of its four squares.
import numpy as np


def log_rotation(R):
    t = np.trace(R)
    squares = np.array([t, R[0, 0], R[1, 1], R[2, 2]])
    k = int(np.argmax(squares))
    w = np.array([1 + t, R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]])
    if k:
        i, j, m = k - 1, k % 3, (k + 1) % 3
        w = np.zeros(4)
        w[0] = R[m, j] - R[j, m]
        w[1 + i] = 1 + R[i, i] - R[j, j] - R[m, m]
        w[1 + j] = R[i, j] + R[j, i]
        w[1 + m] = R[i, m] + R[m, i]
    w = w / np.linalg.norm(w)
    if w[0] < 0:
        w = -w
    n = np.linalg.norm(w[1:])
    if n == 0:
        return np.zeros(3)
    return 2 * np.arctan2(n, w[0]) * w[1:] / n
