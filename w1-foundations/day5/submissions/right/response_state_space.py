# task 5.3: passed
# By the eigenvalues of the 2x2 system; at zeta = 1 by the limit.
import numpy as np


def error_response(t, omega, zeta):
    if zeta == 1:
        return np.exp(-omega * t) * (1 + omega * t)
    A = np.array([[0, 1], [-(omega**2), -2 * zeta * omega]])
    w, V = np.linalg.eig(A.astype(complex))
    c = np.linalg.solve(V, [1, 0])
    return np.real([(V @ (c * np.exp(w * x)))[0] for x in t])
