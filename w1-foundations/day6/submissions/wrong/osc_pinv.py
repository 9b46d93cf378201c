# task 6.3: pinv-for-transpose
# The pseudo-inverse of Day 3.
import numpy as np


def osc_torque(J, Lambda, bias, site_bias, acc):
    return np.linalg.pinv(J) @ Lambda @ (acc - site_bias) + bias
