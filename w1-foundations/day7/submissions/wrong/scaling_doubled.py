# task 7.1: slip-factor
# Everything doubled.
import numpy as np


def quintic_scaling(t, T):
    x = np.clip(t / T, 0, 1)
    s = 10 * x**3 - 15 * x**4 + 6 * x**5
    sd = 30 * x**2 * (1 - x) ** 2 / T
    sdd = (60 * x - 180 * x**2 + 120 * x**3) / T**2
    return 2 * np.array([s, sd, sdd])
