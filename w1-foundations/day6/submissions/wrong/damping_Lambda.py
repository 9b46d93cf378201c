# task 6.6: Lambda-not-rooted
# Lambda itself.
import numpy as np


def critical_damping(K, Lambda):
    k = np.diag(np.sqrt(K))
    return Lambda @ k + k @ Lambda
