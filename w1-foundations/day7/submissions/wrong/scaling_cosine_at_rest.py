# task 7.1: cosine
# The raised cosine between the ends.
import numpy as np


def quintic_scaling(t, T):
    if t <= 0:
        return np.zeros(3)
    if t >= T:
        return np.array([1.0, 0.0, 0.0])
    w = np.pi / T
    return np.array([
        (1 - np.cos(w * t)) / 2,
        w * np.sin(w * t) / 2,
        w**2 * np.cos(w * t) / 2,
    ])  # fmt: skip
