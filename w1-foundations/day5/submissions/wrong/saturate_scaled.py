# task 5.8: all-scaled-down
# Keeps the direction.
import numpy as np


def saturate(tau, limits):
    return tau / max(1.0, np.max(np.abs(tau) / limits))
