# task 2.3: moment-sign
# v = omega x point.
import numpy as np


def screw_axis(axis, point):
    return np.hstack([axis, np.cross(axis, point)])
