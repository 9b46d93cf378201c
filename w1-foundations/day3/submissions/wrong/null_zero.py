# task 3.8: nothing-left
# The inverse of the first six columns, and so nothing is left.
import numpy as np


def null_step(J, dq):
    return dq - dq
