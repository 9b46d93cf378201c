# task 4.8: mass-of-the-step
# What the simulator solves at each step.
import numpy as np


def forward_dynamics(M, bias, damping, qd, tau):
    slower = M + 0.002 * np.diag(damping)
    return np.linalg.solve(slower, tau - bias - damping * qd)
