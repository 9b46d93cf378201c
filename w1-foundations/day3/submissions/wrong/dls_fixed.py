# task 3.5: damping-fixed
# A damping of 0.05, whatever is asked for.
import numpy as np


def dls_step(J, e, damping):
    return J.T @ np.linalg.solve(J @ J.T + 0.05**2 * np.eye(6), e)
