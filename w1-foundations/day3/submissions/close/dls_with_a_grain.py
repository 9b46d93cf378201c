# task 3.5: rounded-somewhere
# A small number is added for safety.
import numpy as np


def dls_step(J, e, damping):
    return J.T @ np.linalg.solve(J @ J.T + (damping**2 + 1e-11) * np.eye(6), e)
