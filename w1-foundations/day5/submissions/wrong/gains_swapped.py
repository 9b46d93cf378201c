# task 5.2: swapped
# kd first.
import numpy as np


def gains(omega, zeta):
    return np.array([2 * zeta * omega, omega**2])
