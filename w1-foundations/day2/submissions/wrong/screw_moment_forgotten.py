# task 2.3: moment-forgotten
# A line through the origin.
import numpy as np


def screw_axis(axis, point):
    return np.hstack([axis, np.zeros(3)])
