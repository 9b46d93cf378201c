# task 5.8: switched-off
# Off when over.
import numpy as np


def saturate(tau, limits):
    return np.where(np.abs(tau) > limits, 0.0, tau)
