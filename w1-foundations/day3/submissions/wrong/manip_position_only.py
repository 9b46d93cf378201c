# task 3.7: position-only
# The v rows alone.
import numpy as np


def manipulability(J):
    J = J[3:]
    return float(np.sqrt(max(0.0, np.linalg.det(J @ J.T))))
