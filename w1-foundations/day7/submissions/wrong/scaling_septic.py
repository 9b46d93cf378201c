# task 7.1: septic
# Degree 7, without jerk at the ends.
import numpy as np


def quintic_scaling(t, T):
    x = np.clip(t / T, 0, 1)
    s = 35 * x**4 - 84 * x**5 + 70 * x**6 - 20 * x**7
    sd = (140 * x**3 - 420 * x**4 + 420 * x**5 - 140 * x**6) / T
    sdd = (420 * x**2 - 1680 * x**3 + 2100 * x**4 - 840 * x**5) / T**2
    return np.array([s, sd, sdd])
