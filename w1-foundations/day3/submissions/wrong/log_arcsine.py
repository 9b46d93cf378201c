# task 3.3: arcsine
# The angle from the arcsine.
import numpy as np


def log_rotation(R):
    a = np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]]) / 2
    sine = np.linalg.norm(a)
    if sine == 0:
        return a
    return a / sine * np.arcsin(min(sine, 1.0))
