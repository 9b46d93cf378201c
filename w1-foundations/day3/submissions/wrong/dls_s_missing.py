# task 3.5: singular-value-missing
# 1 / (s^2 + damping^2) without the s above.
import numpy as np


def dls_step(J, e, damping):
    U, s, Vt = np.linalg.svd(J, full_matrices=False)
    return Vt.T @ ((1 / (s**2 + damping**2)) * (U.T @ e))
