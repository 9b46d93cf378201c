# task 6.3: site-bias-added
# The sign of site_bias.
import numpy as np


def osc_torque(J, Lambda, bias, site_bias, acc):
    return J.T @ Lambda @ (acc + site_bias) + bias
