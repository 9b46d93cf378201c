# task 7.4: passed
# The second half is the first one, mirrored.
import numpy as np


def trapezoid(t, L, v, a):
    top = v if L > v * v / a else (L * a) ** 0.5
    T = L / top + top / a
    if t <= 0:
        return np.array([0.0, 0.0, 0.0])
    if t >= T:
        return np.array([L, 0.0, 0.0])
    if t > T / 2:
        s, sd, sdd = trapezoid(T - t, L, v, a)
        return np.array([L - s, sd, -sdd])
    if t < top / a:
        return np.array([0.5 * a * t * t, a * t, a])
    return np.array([0.5 * top * top / a + top * (t - top / a), top, 0.0])
