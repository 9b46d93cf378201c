# task 6.9: pushes-up
# It lifts off.
import numpy as np


def hybrid_wrench(e, V_err, K, D, force):
    F = K @ e + D @ V_err
    F[5] = D[5] @ V_err + force
    return F
