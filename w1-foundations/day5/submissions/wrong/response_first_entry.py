# task 5.3: first-entry-one (not in a run: t there begins at 0)
# The first entry is 1.
import numpy as np


def error_response(t, omega, zeta):
    if zeta == 1:
        e = (1 + omega * t) * np.exp(-omega * t)
    else:
        r, w = zeta * omega, omega * np.sqrt(complex(zeta**2 - 1))
        a, b = w - r, -w - r
        e = ((b * np.exp(a * t) - a * np.exp(b * t)) / (b - a)).real
    e[0] = 1.0
    return e
