# task 6.6: eigenvalues-not-rooted-back
# diag of the roots, in the wrong axes.
import numpy as np


def critical_damping(K, Lambda):
    values = np.linalg.eigvalsh(Lambda)
    root, k = np.diag(np.sqrt(values)), np.diag(np.sqrt(K))
    return root @ k + k @ root
