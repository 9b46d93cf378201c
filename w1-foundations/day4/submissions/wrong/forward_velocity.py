# task 4.8: velocity-returned
# One step too far.
import numpy as np


def forward_dynamics(M, bias, damping, qd, tau):
    return qd + 0.002 * np.linalg.solve(M, tau - bias - damping * qd)
