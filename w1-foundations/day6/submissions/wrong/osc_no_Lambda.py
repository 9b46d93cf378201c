# task 6.3: Lambda-left-out
# An acceleration used as a push.
import numpy as np


def osc_torque(J, Lambda, bias, site_bias, acc):
    return J.T @ (acc - site_bias) + bias
