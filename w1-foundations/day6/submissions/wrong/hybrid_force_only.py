# task 6.9: force-only
# No springs at all.
import numpy as np


def hybrid_wrench(e, V_err, K, D, force):
    F = D @ V_err
    F[5] -= force
    return F
