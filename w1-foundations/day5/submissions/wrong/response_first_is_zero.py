# task 5.3: time-from-the-first (not in a run: t there begins at 0)
# Counts from t[0].
import numpy as np


def error_response(t, omega, zeta):
    t = t - t[0]
    if zeta == 1:
        return (1 + omega * t) * np.exp(-omega * t)
    r = zeta * omega
    w = omega * np.sqrt(complex(zeta**2 - 1))
    a, b = w - r, -w - r
    return ((b * np.exp(a * t) - a * np.exp(b * t)) / (b - a)).real
