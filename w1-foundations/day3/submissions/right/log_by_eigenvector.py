# task 3.3: passed
# The axis is what R leaves alone: an eigenvector of its symmetric part.
import numpy as np


def log_rotation(R):
    a = np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]]) / 2
    sine = np.linalg.norm(a)
    angle = np.arctan2(sine, (np.trace(R) - 1) / 2)
    if angle < 3:
        return a if sine == 0 else angle * a / sine
    values, vectors = np.linalg.eigh((R + R.T) / 2)
    axis = vectors[:, -1]
    if a @ axis < 0 or (sine < 1e-15 and axis[np.argmax(np.abs(axis))] < 0):
        axis = -axis
    return angle * axis
