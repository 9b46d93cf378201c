# task 6.7: bias-forgotten
# It sags.
import numpy as np


def impedance_torque(J, wrench, bias, damping, qd, tau_null):
    return J.T @ wrench + damping * qd + tau_null
