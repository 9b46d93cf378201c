# task 6.9: moment-in-place-of-force
# The third entry is a moment.
import numpy as np


def hybrid_wrench(e, V_err, K, D, force):
    F = K @ e + D @ V_err
    F[2] = D[2] @ V_err - force
    return F
