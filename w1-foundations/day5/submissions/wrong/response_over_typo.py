# task 5.3: does-not-start-at-one
# A typo in one case: b - a became b.
import numpy as np


def error_response(t, omega, zeta):
    rate = zeta * omega
    if zeta == 1:
        return (1 + omega * t) * np.exp(-omega * t)
    if zeta < 1:
        w = omega * np.sqrt(1 - zeta**2)
        return np.exp(-rate * t) * (np.cos(w * t) + rate / w * np.sin(w * t))
    s = omega * np.sqrt(zeta**2 - 1)
    a, b = rate - s, rate + s
    return (b * np.exp(-a * t) - a * np.exp(-b * t)) / b
