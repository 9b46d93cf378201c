# task 6.7: bias-sign
# Gravity twice.
import numpy as np


def impedance_torque(J, wrench, bias, damping, qd, tau_null):
    return J.T @ wrench - bias + damping * qd + tau_null
