# task 6.6: factor-two
# The 2 of 2 sqrt(k m) on top.
import numpy as np


def critical_damping(K, Lambda):
    values, V = np.linalg.eigh(Lambda)
    root = V @ np.diag(np.sqrt(values)) @ V.T
    k = np.diag(np.sqrt(K))
    return 2 * (root @ k + k @ root)
