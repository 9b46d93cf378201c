# tasks 3.5 3.7 3.8: passed
# Everything from the singular values.
import numpy as np


def dls_step(J, e, damping):
    U, s, Vt = np.linalg.svd(J, full_matrices=False)
    return Vt.T @ (s / (s**2 + damping**2) * (U.T @ e))


def manipulability(J):
    return float(np.prod(np.linalg.svd(J, compute_uv=False)))


def null_step(J, dq):
    _, values, Vt = np.linalg.svd(J)
    rank = np.sum(values > 1e-12 * values[0])
    N = Vt[rank:]
    return N.T @ (N @ dq)
