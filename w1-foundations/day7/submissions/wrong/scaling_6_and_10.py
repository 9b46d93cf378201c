# task 7.1: 6-and-10-swapped
# Two factors in the wrong place.
import numpy as np


def quintic_scaling(t, T):
    x = np.clip(t / T, 0, 1)
    s = 6 * x**3 - 15 * x**4 + 10 * x**5
    sd = (18 * x**2 - 60 * x**3 + 50 * x**4) / T
    sdd = (36 * x - 180 * x**2 + 200 * x**3) / T**2
    return np.array([s, sd, sdd])
