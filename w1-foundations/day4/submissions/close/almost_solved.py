# task 4.8: rounded-somewhere
# Conjugate gradients, stopped too early.
import numpy as np


def forward_dynamics(M, bias, damping, qd, tau):
    x = np.zeros(7)
    r = p = tau - bias - damping * qd
    for _ in range(40):
        if np.linalg.norm(r) < 1e-5:
            break
        step = (r @ r) / (p @ M @ p)
        x, new = x + step * p, r - step * M @ p
        p, r = new + (new @ new) / (r @ r) * p, new
    return x
