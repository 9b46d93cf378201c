# task 5.8: passed
# The median of three.
import numpy as np


def saturate(tau, limits):
    return np.median([-limits, tau, limits], axis=0)
