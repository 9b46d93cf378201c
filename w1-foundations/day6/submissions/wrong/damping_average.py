# task 6.6: factor-two-missing
# The mean of both orders.
import numpy as np


def critical_damping(K, Lambda):
    values, V = np.linalg.eigh(Lambda)
    root = V @ np.diag(np.sqrt(values)) @ V.T
    k = np.diag(np.sqrt(K))
    return (root @ k + k @ root) / 2
