# task 3.7: other-product
# J^T J.
import numpy as np


def manipulability(J):
    return np.sqrt(abs(np.linalg.det(J.T @ J)))
