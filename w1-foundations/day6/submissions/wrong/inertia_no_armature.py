# task 6.1: armature-left-out
# "Armature is not a mass", so it is taken away again.
import numpy as np


def task_inertia(J, M):
    bare = M - 0.1 * np.eye(len(M))
    return np.linalg.inv(J @ np.linalg.inv(bare) @ J.T)
