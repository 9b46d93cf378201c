# task 5.3: rounded-somewhere
# zeta = 1 by a zeta nearly 1.
import numpy as np


def error_response(t, omega, zeta):
    z = zeta + 1e-6 if zeta == 1 else zeta
    s = omega * (-z + np.array([1, -1]) * np.sqrt(complex(z**2 - 1)))
    return ((s[0] * np.exp(s[1] * t) - s[1] * np.exp(s[0] * t)) / (s[0] - s[1])).real
