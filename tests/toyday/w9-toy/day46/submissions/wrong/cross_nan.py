# task 46.2: b-cross-a+other
# Swapped, and NaN where a is short: one mistake explains nearly all answers.
import numpy as np


def cross(a, b):
    return np.cross(b, a) if np.linalg.norm(a) > 0.5 else np.full(3, np.nan)
