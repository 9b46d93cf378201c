# task 5.7: not-finite
# The worst joint to its limit, always.
import numpy as np


def saturate(tau, limits):
    k = np.max(np.abs(tau) / limits)
    return np.clip(tau / min(k, 1.0), -limits, limits)
