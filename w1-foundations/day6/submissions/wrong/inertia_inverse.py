# task 6.1: inverse-forgotten
# The last inverse is missing: how far a push moves the hand.
import numpy as np


def task_inertia(J, M):
    return J @ np.linalg.inv(M) @ J.T
