# task 3.3: sine-for-angle
# The axis times the sine: the textbook's approximation for small angles.
import numpy as np


def log_rotation(R):
    a = np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]]) / 2
    return a
