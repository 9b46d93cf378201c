# task 2.3: twist-order
# (v; omega), as in MuJoCo.
import numpy as np


def screw_axis(axis, point):
    return np.hstack([-np.cross(axis, point), axis])
