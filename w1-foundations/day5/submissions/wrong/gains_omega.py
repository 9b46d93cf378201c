# task 5.2: kp-is-omega
# omega for omega squared.
import numpy as np


def gains(omega, zeta):
    return np.array([omega, 2 * zeta * omega])
