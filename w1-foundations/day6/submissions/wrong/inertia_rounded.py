# task 6.1: answer-changed
# Rounded for printing, and then returned.
import numpy as np


def task_inertia(J, M):
    return np.round(np.linalg.inv(J @ np.linalg.solve(M, J.T)), 3)
