# task 3.7: nan-at-a-singularity (not in a run: rounding at q = 0 differs)
# The root of a product of eigenvalues, one a bit less than 0.
import numpy as np


def manipulability(J):
    return float(np.sqrt(np.prod(np.linalg.eigvalsh(J @ J.T))))
