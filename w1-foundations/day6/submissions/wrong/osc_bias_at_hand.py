# task 6.3: bias-at-the-hand
# bias is made a push first.
import numpy as np


def osc_torque(J, Lambda, bias, site_bias, acc):
    return J.T @ (Lambda @ (acc - site_bias) + J @ bias)
