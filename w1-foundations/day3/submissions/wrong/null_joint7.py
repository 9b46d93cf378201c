# task 3.8: felt
# Joint 7 alone moves, as in the docstring.
import numpy as np


def null_step(J, dq):
    out = np.zeros(7)
    out[6] = dq[6]
    return out
