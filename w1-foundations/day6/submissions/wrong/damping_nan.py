# task 6.6: entries-square-rooted
# np.sqrt of a matrix: NaN where an entry is negative.
import numpy as np


def critical_damping(K, Lambda):
    root, k = np.sqrt(Lambda), np.diag(np.sqrt(K))
    return root @ k + k @ root
