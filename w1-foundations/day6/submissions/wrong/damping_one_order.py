# task 6.6: one-order-only
# 2 sqrt(Lambda) sqrt(K).
import numpy as np


def critical_damping(K, Lambda):
    values, V = np.linalg.eigh(Lambda)
    root = V @ np.diag(np.sqrt(values)) @ V.T
    return 2 * root @ np.diag(np.sqrt(K))
