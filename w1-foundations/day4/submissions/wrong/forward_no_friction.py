# task 4.8: damping-forgotten
# No damping.
import numpy as np


def forward_dynamics(M, bias, damping, qd, tau):
    return np.linalg.solve(M, tau - bias)
