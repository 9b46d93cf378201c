# task 3.5: damping-dropped
# The pseudo-inverse.
import numpy as np


def dls_step(J, e, damping):
    return np.linalg.pinv(J) @ e
