# task 3.7: largest-singular-value
# The norm.
import numpy as np


def manipulability(J):
    return np.linalg.norm(J, 2)
