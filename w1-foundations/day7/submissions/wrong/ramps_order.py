# task 7.4: order
# Acceleration first.
import numpy as np


def trapezoid(t, L, v, a):
    top = min(v, np.sqrt(L * a))
    ramp = top / a
    T = L / top + ramp
    if t <= 0:
        return np.zeros(3)
    if t < ramp:
        return np.array([a, a * t, a * t**2 / 2])
    if t < T - ramp:
        return np.array([0.0, top, top * (t - ramp / 2)])
    if t >= T:
        return np.array([0.0, 0.0, L])
    left = T - t
    return np.array([-a, a * left, L - a * left**2 / 2])
