# task 46.1: in-degrees
# Degrees.
import numpy as np


def angle_between(a, b):
    c = a @ b / np.linalg.norm(a) / np.linalg.norm(b)
    return np.degrees(np.arccos(np.clip(c, -1.0, 1.0)))
