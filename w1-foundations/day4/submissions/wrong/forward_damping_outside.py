# task 4.8: damping-not-divided
# A bracket too early.
import numpy as np


def forward_dynamics(M, bias, damping, qd, tau):
    return np.linalg.solve(M, tau - bias) - damping * qd
