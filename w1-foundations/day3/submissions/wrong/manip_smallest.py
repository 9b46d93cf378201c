# task 3.7: smallest-singular-value
# The smallest singular value.
import numpy as np


def manipulability(J):
    return np.linalg.svd(J, compute_uv=False)[-1]
