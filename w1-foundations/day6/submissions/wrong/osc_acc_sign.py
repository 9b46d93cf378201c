# task 6.3: acc-sign
# Measured minus wanted.
import numpy as np


def osc_torque(J, Lambda, bias, site_bias, acc):
    return J.T @ Lambda @ (site_bias - acc) + bias
