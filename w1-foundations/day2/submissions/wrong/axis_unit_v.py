# task 2.3: second-half-off
# Both halves are made of length 1.
import numpy as np


def screw_axis(axis, point):
    v = np.cross(point, axis)
    return np.append(axis, v / (np.linalg.norm(v) or 1.0))
