# task 3.5: zero-without-damping (not in a run: step 6 checks nothing)
# Zeros where damping is 0.
import numpy as np


def dls_step(J, e, damping):
    if damping == 0:
        return np.zeros(7)
    return J.T @ np.linalg.solve(J @ J.T + damping**2 * np.eye(6), e)
