# task 6.3: gravity-twice
# The bias for holding, and once more for moving.
import numpy as np


def osc_torque(J, Lambda, bias, site_bias, acc):
    hold = bias.copy()
    return J.T @ Lambda @ (acc - site_bias) + bias + hold
