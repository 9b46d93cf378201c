# task 7.3: way-wrapped
# The shorter way round.
import numpy as np


def quintic_scaling(t, T):
    x = np.clip(t / T, 0.0, 1.0)
    s = 10 * x**3 - 15 * x**4 + 6 * x**5
    sd = 30 * x**2 * (1 - x) ** 2 / T
    sdd = (60 * x - 180 * x**2 + 120 * x**3) / T**2
    return np.array([s, sd, sdd])


def joint_move(q0, q1, t, T):
    s, sd, sdd = quintic_scaling(t, T)
    way = (q1 - q0 + np.pi) % (2 * np.pi) - np.pi
    return np.array([q0 + way * s, way * sd, way * sdd])
