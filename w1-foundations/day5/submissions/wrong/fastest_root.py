# task 5.9: larger-root
# The other root.
import numpy as np


def fastest(h):
    return 2.0 * (np.sqrt(2.0) + 1.0) / h


def servo_ctrl(tau, q, qd, kp, kd):
    return q + (tau + kd * qd) / kp
