# task 6.6: K-not-rooted
# K itself.
import numpy as np


def critical_damping(K, Lambda):
    values, V = np.linalg.eigh(Lambda)
    root = V @ np.diag(np.sqrt(values)) @ V.T
    return root @ np.diag(K) + np.diag(K) @ root
