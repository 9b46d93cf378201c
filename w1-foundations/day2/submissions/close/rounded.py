# task 2.3: rounded
# Rounded for reading.
import numpy as np


def screw_axis(axis, point):
    return np.round(np.hstack([axis, -np.cross(axis, point)]), 6)
