# task 6.7: halves-swapped
# MuJoCo's order of wrenches.
import numpy as np


def impedance_torque(J, wrench, bias, damping, qd, tau_null):
    F = np.hstack([wrench[3:], wrench[:3]])
    return J.T @ F + bias + damping * qd + tau_null
