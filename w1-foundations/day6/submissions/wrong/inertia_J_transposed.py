# task 6.1: raises
# J and J^T have changed places.
import numpy as np


def task_inertia(J, M):
    return np.linalg.inv(J.T @ np.linalg.solve(M, J))
