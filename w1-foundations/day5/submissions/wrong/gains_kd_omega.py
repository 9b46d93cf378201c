# task 5.2: kd-is-omega
# It tracks better than the right one.
import numpy as np


def gains(omega, zeta):
    return np.array([omega**2, omega])
