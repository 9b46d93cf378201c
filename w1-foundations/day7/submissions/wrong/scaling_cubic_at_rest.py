# task 7.1: cubic
# The cubic, its acceleration 0 at the ends.
import numpy as np


def quintic_scaling(t, T):
    x = np.clip(t / T, 0, 1)
    inside = 0 < x < 1
    return np.array([
        3 * x**2 - 2 * x**3,
        (6 * x - 6 * x**2) / T,
        (6 - 12 * x) / T**2 * inside,
    ])  # fmt: skip
