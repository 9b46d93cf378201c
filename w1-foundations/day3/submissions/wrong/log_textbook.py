# task 3.3: wrong-near-pi
# theta / (2 sin theta), with the arccosine, and a guard at 0.
import numpy as np


def log_rotation(R):
    a = np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]]) / 2
    angle = np.arccos(np.clip((np.trace(R) - 1) / 2, -1, 1))
    if np.sin(angle) < 1e-12:
        return a
    return a * angle / np.sin(angle)
