# task 5.3: window-around-one (not in a run: no zeta there is so near to 1)
# Nearly 1 counts as 1, in a narrow window.
import numpy as np


def error_response(t, omega, zeta):
    if abs(zeta - 1) < 1e-3:
        return (1 + omega * t) * np.exp(-omega * t)
    r = zeta * omega
    w = omega * np.sqrt(complex(zeta**2 - 1))
    a, b = w - r, -w - r
    return ((b * np.exp(a * t) - a * np.exp(b * t)) / (b - a)).real
