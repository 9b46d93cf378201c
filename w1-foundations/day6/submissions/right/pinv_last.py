# task 6.1: passed
# A pseudo-inverse, which away from singularities is the inverse.
import numpy as np


def task_inertia(J, M):
    return np.linalg.pinv(J @ np.linalg.pinv(M) @ J.T)
