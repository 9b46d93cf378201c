# task 5.2: two-forgotten
# zeta omega.
import numpy as np


def gains(omega, zeta):
    return np.array([omega**2, zeta * omega])
