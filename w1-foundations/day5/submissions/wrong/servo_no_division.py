# task 5.9: stiffness-forgotten
# No division.
import numpy as np


def fastest(h):
    return 2 * (np.sqrt(2) - 1) / h


def servo_ctrl(tau, q, qd, kp, kd):
    return q + tau + kd * qd
