# task 7.1: linear
# Constant speed.
import numpy as np


def quintic_scaling(t, T):
    x = np.clip(t / T, 0, 1)
    s = x
    sd = (1 / T) * np.ones_like(x)
    sdd = 0.0
    return np.array([s, sd, sdd])
