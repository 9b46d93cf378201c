# task 6.6: passed
# The root by an SVD.
import numpy as np


def critical_damping(K, Lambda):
    U, s, _ = np.linalg.svd(Lambda)
    root = U @ np.diag(np.sqrt(s)) @ U.T
    k = np.sqrt(K)
    return root * k + root * k[:, None]
