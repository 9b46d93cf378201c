# task 2.3: divided-by-its-length
# The whole screw is made unit.
import numpy as np


def skew(w):
    x, y, z = w
    return np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])


def screw_axis(axis, point):
    S = np.hstack([axis, -np.cross(axis, point)])
    return S / np.linalg.norm(S)
