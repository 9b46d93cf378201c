# task 6.1: passed
# One unit acceleration after the other.
import numpy as np


def task_inertia(J, M):
    A = J @ np.linalg.inv(M) @ J.T
    columns = [np.linalg.solve(A, unit) for unit in np.eye(6)]
    return np.array(columns).T
