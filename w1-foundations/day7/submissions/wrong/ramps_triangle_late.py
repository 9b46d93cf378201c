# task 7.4: triangle-too-late
# The way of one ramp for the way of both.
import numpy as np


def trapezoid(t, L, v, a):
    top = np.sqrt(L * a) if v**2 / (2 * a) > L else v
    ramp = top / a
    T = L / top + ramp
    if t <= 0:
        return np.zeros(3)
    if t >= T:
        return np.array([L, 0.0, 0.0])
    if t < ramp:
        return np.array([a * t**2 / 2, a * t, a])
    if t < T - ramp:
        return np.array([top * (t - ramp / 2), top, 0.0])
    left = T - t
    return np.array([L - a * left**2 / 2, a * left, -a])
