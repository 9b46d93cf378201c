# task 3.5: damping-added-to-the-values
# 1 / (s + damping) by the singular values.
import numpy as np


def dls_step(J, e, damping):
    U, s, Vt = np.linalg.svd(J, full_matrices=False)
    return Vt.T @ ((1 / (s + damping)) * (U.T @ e))
