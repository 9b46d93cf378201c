# task 2.1: passed
# Column by column.
import numpy as np


def skew(w):
    return np.array([np.cross(w, e) for e in np.eye(3)]).T
