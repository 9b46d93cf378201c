# task 3.5: damping-squared-twice
# The damping is squared twice.
import numpy as np


def dls_step(J, e, damping):
    return J.T @ np.linalg.solve(J @ J.T + damping**4 * np.eye(6), e)
