# task 6.7: null-sign
# The elbow is driven away.
import numpy as np


def impedance_torque(J, wrench, bias, damping, qd, tau_null):
    return J.T @ wrench + bias + damping * qd - tau_null
