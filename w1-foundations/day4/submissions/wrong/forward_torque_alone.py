# task 4.8: only-torque-divided
# Brackets in the wrong place.
import numpy as np


def forward_dynamics(M, bias, damping, qd, tau):
    return np.linalg.solve(M, tau) - bias - damping * qd
