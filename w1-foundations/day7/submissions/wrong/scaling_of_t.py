# task 7.1: t-for-x
# The time itself in the polynomial.
import numpy as np


def quintic_scaling(t, T):
    x = t
    s = 10 * x**3 - 15 * x**4 + 6 * x**5
    sd = 30 * x**2 * (1 - x) ** 2
    sdd = 60 * x - 180 * x**2 + 120 * x**3
    return np.array([s, sd, sdd])
