# task 6.3: bias-forgotten
# No gravity, no Coriolis.
import numpy as np


def osc_torque(J, Lambda, bias, site_bias, acc):
    return J.T @ (Lambda @ (acc - site_bias))
