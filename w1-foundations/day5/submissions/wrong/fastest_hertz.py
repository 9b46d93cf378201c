# task 5.9: in-hertz
# Hz.
import numpy as np


def fastest(h):
    return (np.sqrt(2.0) - 1.0) / h / np.pi


def servo_ctrl(tau, q, qd, kp, kd):
    return q + (tau + kd * qd) / kp
