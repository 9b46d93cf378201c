# task 6.8: passed
# With NumPy, as an array of no axes.
import numpy as np


def set_point_for_force(force, k, surface):
    return np.subtract(surface, np.divide(force, k))
