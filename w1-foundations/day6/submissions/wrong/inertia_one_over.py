# task 6.1: entries-inverted
# 1 / A for the inverse of A.
import numpy as np


def task_inertia(J, M):
    return 1 / (J @ np.linalg.solve(M, J.T))
