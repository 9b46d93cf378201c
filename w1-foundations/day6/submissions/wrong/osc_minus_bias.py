# task 6.3: bias-sign
# The sign of bias.
import numpy as np


def osc_torque(J, Lambda, bias, site_bias, acc):
    return J.T @ (Lambda @ (acc - site_bias)) - bias
