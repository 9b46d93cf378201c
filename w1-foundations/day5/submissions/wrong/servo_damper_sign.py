# task 5.9: damper-sign
# kd counted twice.
import numpy as np


def servo_ctrl(tau, q, qd, kp, kd):
    return q + (tau - kd * qd) / kp


def fastest(h):
    return 2.0 * (np.sqrt(2.0) - 1.0) / h
