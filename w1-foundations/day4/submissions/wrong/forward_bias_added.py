# task 4.8: bias-sign
# Plus bias.
import numpy as np


def forward_dynamics(M, bias, damping, qd, tau):
    return np.linalg.solve(M, tau + bias - damping * qd)
