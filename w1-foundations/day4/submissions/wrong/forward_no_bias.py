# task 4.8: bias-forgotten
# No gravity, no Coriolis.
import numpy as np


def forward_dynamics(M, bias, damping, qd, tau):
    return np.linalg.solve(M, tau - damping * qd)
