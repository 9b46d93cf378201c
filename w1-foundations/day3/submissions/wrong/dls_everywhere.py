# task 3.5: damping-everywhere
# The identity is forgotten.
import numpy as np


def dls_step(J, e, damping):
    return J.T @ np.linalg.solve(J @ J.T + damping**2, e)
