# task 5.9: undamped-limit
# 2 / h.
import numpy as np


def fastest(h):
    return 2.0 / h


def servo_ctrl(tau, q, qd, kp, kd):
    return q + (tau + kd * qd) / kp
