# task 3.8: felt
# The pseudo-inverse leaves small values out.
import numpy as np


def manipulability(J):
    return np.linalg.svd(J, compute_uv=False).prod()


def nullspace_projection(J, dq):
    return dq - np.linalg.pinv(J, rcond=1e-2) @ (J @ dq)
