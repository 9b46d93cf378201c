# task 6.6: cholesky
# A Cholesky factor for the root.
import numpy as np


def critical_damping(K, Lambda):
    root, k = np.linalg.cholesky(Lambda), np.diag(np.sqrt(K))
    return root @ k + k @ root
