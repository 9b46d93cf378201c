# task 46.2: off
# Swapped, and NaN where a is short: no one mistake explains all answers.
import numpy as np


def cross(a, b):
    return np.cross(b, a) if np.linalg.norm(a) > 0.5 else np.full(3, np.nan)
