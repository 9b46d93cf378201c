# task 6.1: rounded-somewhere
# A little is added against singularities.
import numpy as np


def task_inertia(J, M):
    A = J @ np.linalg.solve(M, J.T)
    return np.linalg.inv(A + 1e-9 * np.eye(6))
