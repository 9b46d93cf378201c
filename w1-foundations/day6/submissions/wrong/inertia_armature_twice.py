# task 6.1: armature-twice
# The rotors again.
import numpy as np


def task_inertia(J, M):
    return np.linalg.inv(J @ np.linalg.solve(M + 0.1 * np.eye(7), J.T))
