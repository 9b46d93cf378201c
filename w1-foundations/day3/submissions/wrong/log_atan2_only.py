# task 3.3: wrong-near-pi
# atan2 gives the angle, but near pi the axis is still divided by the sine, and cut off.
import numpy as np


def log_rotation(R):
    a = np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]]) / 2
    sine = np.linalg.norm(a)
    angle = np.arctan2(sine, (np.trace(R) - 1) / 2)
    return a * angle / max(sine, 1e-7)
