# task 46.2: b-cross-a
# Swapped, and NaN where a is short: neither hides the other.
import numpy as np


def cross(a, b):
    return np.cross(b, a) if np.linalg.norm(a) > 0.5 else np.full(3, np.nan)
