# task 7.1: only-s-clipped
# s is clipped, not the time.
import numpy as np


def quintic_scaling(t, T):
    x = t / T
    s = 0 if x < 0 else 1 if x > 1 else 10 * x**3 - 15 * x**4 + 6 * x**5
    sd = (30 * x**2 - 60 * x**3 + 30 * x**4) / T
    return np.array([s, sd, (60 * x - 180 * x**2 + 120 * x**3) / T**2])
