# task 3.7: raises
# J is not square.
import numpy as np


def manipulability(J):
    return np.sqrt(np.linalg.det(J))
