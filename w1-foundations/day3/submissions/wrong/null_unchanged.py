# task 3.8: unchanged
# dq comes back.
import numpy as np


def null_step(J, dq):
    return dq.copy()
