# task 4.8: rounded-somewhere
# M is rounded to eight decimals before it is used.
import numpy as np


def forward_dynamics(M, bias, damping, qd, tau):
    return np.linalg.solve(np.round(M, 8), tau - bias - damping * qd)
