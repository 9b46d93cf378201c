# task 3.8: damped-projector
# The damped inverse in the projector.
import numpy as np


def dls_step(J: np.ndarray, e: np.ndarray, damping: float) -> np.ndarray:
    return J.T @ np.linalg.solve(J @ J.T + damping**2 * np.eye(6), e)


def null_step(J, dq):
    return dq - dls_step(J, J @ dq, 0.05)
