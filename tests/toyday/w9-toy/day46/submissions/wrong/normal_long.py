# task 46.6: not-unit (not in a run: only its direction is used)
# Not scaled to length 1.
import numpy as np


def normal(v):
    return np.cross(v, np.eye(3)[np.argmin(np.abs(v))])
