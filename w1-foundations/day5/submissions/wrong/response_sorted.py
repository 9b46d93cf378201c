# task 5.3: times-sorted (not in a run: t there is in order)
# Sorts t.
import numpy as np


def error_response(t, omega, zeta):
    t = np.sort(t)
    if zeta == 1:
        return (1 + omega * t) * np.exp(-omega * t)
    r = zeta * omega
    w = omega * np.sqrt(complex(zeta**2 - 1))
    a, b = w - r, -w - r
    return ((b * np.exp(a * t) - a * np.exp(b * t)) / (b - a)).real
