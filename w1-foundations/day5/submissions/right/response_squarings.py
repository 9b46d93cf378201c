# task 5.3: passed
# Exponential of the 2x2 matrix: Taylor and squarings.
import numpy as np


def error_response(t, omega, zeta):
    A = np.array([[0.0, 1.0], [-(omega**2), -2 * zeta * omega]])
    out = []
    for x in t:
        B, E, term = A * x / 2**12, np.eye(2), np.eye(2)
        for k in range(1, 12):
            term = term @ B / k
            E = E + term
        for _ in range(12):
            E = E @ E
        out.append(E[0, 0])
    return np.array(out)
