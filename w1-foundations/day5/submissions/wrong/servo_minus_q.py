# task 5.9: angle-subtracted
# q off.
import numpy as np


def fastest(h):
    return 2 * (np.sqrt(2) - 1) / h


def servo_ctrl(tau, q, qd, kp, kd):
    return (tau + kd * qd) / kp - q
