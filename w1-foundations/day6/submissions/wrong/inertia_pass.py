# task 6.1: nothing-returned
# Computed, and not returned.
import numpy as np


def task_inertia(J, M):
    Lambda = np.linalg.inv(J @ np.linalg.solve(M, J.T))
