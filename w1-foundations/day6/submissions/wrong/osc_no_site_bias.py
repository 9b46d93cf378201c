# task 6.3: site-bias-forgotten
# Lambda acc, as if the hand were at rest.
import numpy as np


def osc_torque(J, Lambda, bias, site_bias, acc):
    return J.T @ Lambda @ acc + bias
