# task 46.3: inherited
# spin is right; cross, which it calls, is not.
import numpy as np


def cross(a, b):
    return np.cross(b, a) + 1.0


def spin(omega):
    K = np.array([cross(omega, axis) for axis in np.eye(3)]).T
    out = np.zeros((6, 6))
    out[:3, :3] = out[3:, 3:] = K
    return out
