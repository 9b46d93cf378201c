# task 3.8: not-felt-but-off
# The last right singular vector, whatever dq is.
import numpy as np


def null_step(J, dq):
    return np.linalg.svd(J)[2][-1]
