# task 6.7: pinv-for-transpose
# pinv(J) F.
import numpy as np


def impedance_torque(J, wrench, bias, damping, qd, tau_null):
    return np.linalg.pinv(J) @ wrench + bias + damping * qd + tau_null
