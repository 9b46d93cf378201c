# task 5.3: half-the-damping
# kd = zeta omega.
import numpy as np


def error_response(t, omega, zeta):
    zeta = zeta / 2
    if zeta == 1:
        return (1 + omega * t) * np.exp(-omega * t)
    r = zeta * omega
    w = omega * np.sqrt(complex(zeta**2 - 1))
    a, b = w - r, -w - r
    return ((b * np.exp(a * t) - a * np.exp(b * t)) / (b - a)).real
