# task 5.8: shares-its-argument (not in a run: the numbers are right)
# Hands its argument back.
import numpy as np


def saturate(tau, limits):
    if np.all(np.abs(tau) <= limits):
        return tau
    return np.clip(tau, -limits, limits)
