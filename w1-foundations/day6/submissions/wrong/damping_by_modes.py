# task 6.6: another-design
# Double diagonalisation: it does not ring either.
import numpy as np


def critical_damping(K, Lambda):
    L = np.linalg.cholesky(Lambda)
    back = np.linalg.inv(L)
    k, W = np.linalg.eigh(back @ np.diag(K) @ back.T)
    Q = L @ W
    return 2 * Q @ np.diag(np.sqrt(k)) @ Q.T
