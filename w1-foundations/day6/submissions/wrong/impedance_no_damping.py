# task 6.7: damping-forgotten
# The joints rub.
import numpy as np


def impedance_torque(J, wrench, bias, damping, qd, tau_null):
    return J.T @ wrench + bias + tau_null
