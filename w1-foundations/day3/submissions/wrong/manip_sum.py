# task 3.7: sum-of-singular-values
# The sum.
import numpy as np


def manipulability(J):
    return np.linalg.svd(J, compute_uv=False).sum()
