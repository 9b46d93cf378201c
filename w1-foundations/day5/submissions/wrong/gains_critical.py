# task 5.2: zeta-ignored
# Always critical.
import numpy as np


def gains(omega, zeta):
    return np.array([omega**2, 2 * omega])
