# task 5.9: nyquist
# pi / h.
import numpy as np


def fastest(h):
    return np.pi / h


def servo_ctrl(tau, q, qd, kp, kd):
    return q + (tau + kd * qd) / kp
