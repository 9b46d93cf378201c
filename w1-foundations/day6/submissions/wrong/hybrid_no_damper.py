# task 6.9: damper-left-out
# It bounces.
import numpy as np


def hybrid_wrench(e, V_err, K, D, force):
    F = K @ e + D @ V_err
    F[5] = -force
    return F
