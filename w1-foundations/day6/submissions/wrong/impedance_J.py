# task 6.7: raises
# J for J^T.
import numpy as np


def impedance_torque(J, wrench, bias, damping, qd, tau_null):
    return J @ wrench + bias + damping * qd + tau_null
