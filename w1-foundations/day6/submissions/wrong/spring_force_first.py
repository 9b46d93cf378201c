# task 6.5: halves-swapped
# (force; moment).
import numpy as np


def spring_wrench(e, V_err, K, D):
    F = K @ e + D @ V_err
    return np.hstack([F[3:], F[:3]])
