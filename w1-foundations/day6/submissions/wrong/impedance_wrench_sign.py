# task 6.7: wrench-sign
# The push of the table, not of the hand.
import numpy as np


def impedance_torque(J, wrench, bias, damping, qd, tau_null):
    return bias + damping * qd + tau_null - J.T @ wrench
