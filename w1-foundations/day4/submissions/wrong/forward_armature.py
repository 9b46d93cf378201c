# task 4.8: armature-twice
# M has it already.
import numpy as np


def forward_dynamics(M, bias, damping, qd, tau):
    return np.linalg.solve(M + 0.1 * np.eye(7), tau - bias - damping * qd)
