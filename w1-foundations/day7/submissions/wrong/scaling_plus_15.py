# task 7.1: sign-of-15
# A sign lost on the way from the book.
import numpy as np


def quintic_scaling(t, T):
    x = np.clip(t / T, 0, 1)
    s = 10 * x**3 + 15 * x**4 + 6 * x**5
    sd = (30 * x**2 + 60 * x**3 + 30 * x**4) / T
    sdd = (60 * x + 180 * x**2 + 120 * x**3) / T**2
    return np.array([s, sd, sdd])
