# task 5.3: passed
# One complex formula for under and over.
import numpy as np


def error_response(t, omega, zeta):
    if zeta == 1:
        return (1 + omega * t) / np.exp(omega * t)
    s = omega * (-zeta + np.array([1, -1]) * np.sqrt(complex(zeta**2 - 1)))
    return ((s[0] * np.exp(s[1] * t) - s[1] * np.exp(s[0] * t)) / (s[0] - s[1])).real
