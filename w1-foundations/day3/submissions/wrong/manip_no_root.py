# task 3.7: no-square-root
# The root is forgotten.
import numpy as np


def manipulability(J):
    return np.linalg.det(J @ J.T)
