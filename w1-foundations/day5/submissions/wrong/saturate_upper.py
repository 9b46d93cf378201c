# task 5.8: above-only
# np.minimum.
import numpy as np


def saturate(tau, limits):
    return np.minimum(tau, limits)
