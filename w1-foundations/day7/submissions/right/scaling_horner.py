# task 7.1: passed
# Horner's scheme, and the time stopped by hand.
import numpy as np


def quintic_scaling(t, T):
    if t <= 0:
        return np.array([0.0, 0.0, 0.0])
    if t >= T:
        return np.array([1.0, 0.0, 0.0])
    x = t / T
    s = x * x * x * (10 + x * (-15 + x * 6))
    sd = x * x * (30 + x * (-60 + x * 30)) / T
    sdd = x * (60 + x * (-180 + x * 120)) / (T * T)
    return np.array([s, sd, sdd])
