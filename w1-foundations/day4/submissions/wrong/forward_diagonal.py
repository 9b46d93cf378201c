# task 4.8: diagonal-only
# Each joint by itself.
import numpy as np


def forward_dynamics(M, bias, damping, qd, tau):
    return (tau - bias - damping * qd) / np.diag(M)
