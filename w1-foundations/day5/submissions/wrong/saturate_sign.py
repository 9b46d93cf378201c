# task 5.8: sign-lost
# Limits without a sign.
import numpy as np


def saturate(tau, limits):
    return np.where(np.abs(tau) > limits, limits, tau)
