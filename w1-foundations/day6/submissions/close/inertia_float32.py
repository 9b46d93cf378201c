# task 6.1: rounded-somewhere
# float32 inside.
import numpy as np


def task_inertia(J, M):
    A = (J @ np.linalg.solve(M, J.T)).astype(np.float32)
    return np.linalg.inv(A.astype(np.float64))
