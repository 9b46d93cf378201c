# task 7.1: cosine
# A raised cosine, as Day 5 had it.
import numpy as np


def quintic_scaling(t, T):
    x = np.clip(t / T, 0, 1)
    s = (1 - np.cos(np.pi * x)) / 2
    sd = np.pi * np.sin(np.pi * x) / 2 / T
    sdd = np.pi**2 * np.cos(np.pi * x) / 2 / T**2
    return np.array([s, sd, sdd])
