# task 3.5: all-signs
# It steps away.
import numpy as np


def dls_step(J, e, damping):
    return -J.T @ np.linalg.solve(J @ J.T + damping**2 * np.eye(6), e)
