# task 5.9: one-gain-for-all
# kp[0].
import numpy as np


def fastest(h):
    return 2 * (np.sqrt(2) - 1) / h


def servo_ctrl(tau, q, qd, kp, kd):
    return q + (tau + kd * qd) / kp[0]
