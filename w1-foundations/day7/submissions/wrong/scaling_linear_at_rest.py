# task 7.1: linear
# One rate between the ends.
import numpy as np


def quintic_scaling(t, T):
    x = np.clip(t / T, 0, 1)
    return np.array([x, (0 < x < 1) / T, 0.0])
