# task 5.3: passed
# cosh and sinh over 1.
import numpy as np


def error_response(t, omega, zeta):
    r = zeta * omega
    w = omega * np.sqrt(abs(1 - zeta**2))
    if w == 0:
        return (1 + r * t) * np.exp(-r * t)
    c, s = (np.cos, np.sin) if zeta < 1 else (np.cosh, np.sinh)
    return np.exp(-r * t) * (c(w * t) + r * s(w * t) / w)
