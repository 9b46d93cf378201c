# task 6.1: shape
# The inverse of M: of the joints, not of the hand.
import numpy as np


def task_inertia(J, M):
    return np.linalg.inv(M)
