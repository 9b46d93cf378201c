# task 3.5: raises
# A 7x7 matrix and six numbers.
import numpy as np


def dls_step(J, e, damping):
    return np.linalg.solve(J.T @ J + damping**2 * np.eye(7), e)
