# task 5.9: passed
# By halving, on the eigenvalues.
import numpy as np


def fastest(h):
    low, high = 0.1 / h, 1.9 / h
    for _ in range(100):
        w = (low + high) / 2
        step = [[1 - (h * w) ** 2, h - 2 * w * h * h], [-h * w * w, 1 - 2 * h * w]]
        stable = np.abs(np.linalg.eigvals(step)).max() < 1
        low, high = (w, high) if stable else (low, w)
    return low


def servo_ctrl(tau, q, qd, kp, kd):
    return q + (tau + kd * qd) / kp
