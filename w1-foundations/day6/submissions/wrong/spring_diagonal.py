# task 6.5: diagonal-of-D
# Entry by entry.
import numpy as np


def spring_wrench(e, V_err, K, D):
    return np.diag(K) * e + np.diag(D) * V_err
