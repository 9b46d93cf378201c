# task 2.3: axis-turned-round
# Every axis is made to point the positive way.
import numpy as np


def skew(w):
    x, y, z = w
    return np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])


def screw_axis(axis, point):
    a = axis if axis[np.argmax(np.abs(axis))] > 0 else -axis
    return np.hstack([a, -np.cross(a, point)])
