# task 6.6: diagonal-only
# 2 sqrt(k m), axis by axis.
import numpy as np


def critical_damping(K, Lambda):
    return np.diag(2 * np.sqrt(K * np.diag(Lambda)))
