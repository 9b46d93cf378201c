# task 6.6: eigenvectors-transposed
# V^T diag V.
import numpy as np


def critical_damping(K, Lambda):
    values, V = np.linalg.eigh(Lambda)
    root = V.T @ np.diag(np.sqrt(values)) @ V
    k = np.diag(np.sqrt(K))
    return root @ k + k @ root
