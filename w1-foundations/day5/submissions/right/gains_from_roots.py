# task 5.2: passed
# From the two roots of the polynomial.
import numpy as np


def gains(omega, zeta):
    root = np.sqrt(complex(zeta**2 - 1))
    a, b = omega * (-zeta + root), omega * (-zeta - root)
    return np.array([(a * b).real, -(a + b).real])
