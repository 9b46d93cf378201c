# task 4.8: damping-sign-lost
# As if a speed were a size.
import numpy as np


def forward_dynamics(M, bias, damping, qd, tau):
    return np.linalg.solve(M, tau - bias - damping * abs(qd))
