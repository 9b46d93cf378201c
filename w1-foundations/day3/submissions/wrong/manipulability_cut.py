# task 3.8: off
# Values under 0.01 count as 0.
import numpy as np


def manipulability(J):
    s = np.linalg.svd(J, compute_uv=False)
    return np.prod(s * (s > 0.01))
