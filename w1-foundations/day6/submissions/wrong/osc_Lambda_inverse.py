# task 6.3: Lambda-inverted
# Divided by the mass.
import numpy as np


def osc_torque(J, Lambda, bias, site_bias, acc):
    return J.T @ np.linalg.solve(Lambda, acc - site_bias) + bias
