# task 6.3: Lambda-by-entries
# Each direction with its own mass.
import numpy as np


def osc_torque(J, Lambda, bias, site_bias, acc):
    return J.T @ (np.diag(Lambda) * (acc - site_bias)) + bias
