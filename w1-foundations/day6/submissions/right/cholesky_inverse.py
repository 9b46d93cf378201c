# task 6.1: passed
# By a Cholesky factor of M.
import numpy as np


def task_inertia(J, M):
    L = np.linalg.cholesky(M)
    A = np.linalg.solve(L, J.T)
    return np.linalg.inv(A.T @ A)
