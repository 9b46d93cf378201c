# task 3.5: damping-doubled
# damping * 2.
import numpy as np


def dls_step(J, e, damping):
    return J.T @ np.linalg.solve(J @ J.T + damping * 2 * np.eye(6), e)
