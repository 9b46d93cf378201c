# task 2.3: axis-reversed
# The other way round.
import numpy as np


def screw_axis(axis, point):
    return np.hstack([-axis, np.cross(axis, point)])
