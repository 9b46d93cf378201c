# task 6.3: gravity-twice
# The bias for holding, and once more for moving.
import numpy as np


def osc_torque(J, Lambda, bias, drift, acc):
    hold = bias.copy()
    return J.T @ Lambda @ (acc - drift) + bias + hold
