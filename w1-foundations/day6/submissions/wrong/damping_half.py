# task 6.6: half-of-it
# One product.
import numpy as np


def critical_damping(K, Lambda):
    values, V = np.linalg.eigh(Lambda)
    root = V @ np.diag(np.sqrt(values)) @ V.T
    return root @ np.diag(np.sqrt(K))
