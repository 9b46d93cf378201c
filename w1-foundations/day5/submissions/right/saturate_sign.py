# task 5.8: passed
# By sign and size.
import numpy as np


def saturate(tau, limits):
    return np.sign(tau) * np.minimum(np.abs(tau), limits)
