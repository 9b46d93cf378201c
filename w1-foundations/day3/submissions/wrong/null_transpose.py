# task 3.8: transpose-for-pseudo-inverse
# I - J^T J.
import numpy as np


def null_step(J, dq):
    return dq - J.T @ (J @ dq)
