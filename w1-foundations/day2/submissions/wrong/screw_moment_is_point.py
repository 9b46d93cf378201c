# task 2.3: moment-is-point
# (axis; point).
import numpy as np


def screw_axis(axis, point):
    return np.hstack([axis, point])
