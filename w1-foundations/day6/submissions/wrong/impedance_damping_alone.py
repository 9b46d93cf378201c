# task 6.7: damping-without-qd
# A gain used as a torque.
import numpy as np


def impedance_torque(J, wrench, bias, damping, qd, tau_null):
    return J.T @ wrench + bias + damping + tau_null
