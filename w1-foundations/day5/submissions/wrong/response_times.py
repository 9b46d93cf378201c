# task 5.3: off (not in a run: t there begins at 0)
# One step of t for all.
import numpy as np


def error_response(t, omega, zeta):
    t = np.linspace(0, t[-1], len(t)) if t[0] else t
    if zeta == 1:
        return (1 + omega * t) * np.exp(-omega * t)
    r = zeta * omega
    w = omega * np.sqrt(complex(zeta**2 - 1))
    a, b = w - r, -w - r
    return ((b * np.exp(a * t) - a * np.exp(b * t)) / (b - a)).real
