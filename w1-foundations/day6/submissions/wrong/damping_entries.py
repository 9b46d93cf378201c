# task 6.6: entries-square-rooted
# np.sqrt of a matrix, its negative entries made positive.
import numpy as np


def critical_damping(K, Lambda):
    root, k = np.sqrt(np.abs(Lambda)), np.diag(np.sqrt(K))
    return root @ k + k @ root
