# task 5.8: one-over-stops-all
# Emergency stop.
import numpy as np


def saturate(tau, limits):
    if np.any(np.abs(tau) > limits):
        return np.zeros(7)
    return tau.copy()
