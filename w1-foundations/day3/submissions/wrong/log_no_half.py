# task 3.3: twice-the-sine
# The half is forgotten.
import numpy as np


def log_rotation(R):
    return np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]])
