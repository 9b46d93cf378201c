# task 5.9: rounded-somewhere
# 0.828427 typed.
import numpy as np


def fastest(h):
    return 0.828427 / h


def servo_ctrl(tau, q, qd, kp, kd):
    return q + (tau + kd * qd) / kp
