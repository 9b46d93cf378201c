# task 5.3: not-finite
# zeta = 1 divides by zero.
import numpy as np


def error_response(t, omega, zeta):
    r = zeta * omega
    w = omega * np.sqrt(np.abs(1 - zeta**2))
    if zeta > 1:
        return np.exp(-r * t) * (np.cosh(w * t) + r / w * np.sinh(w * t))
    return np.exp(-r * t) * (np.cos(w * t) + r / w * np.sin(w * t))
