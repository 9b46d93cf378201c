# task 5.2: omega-in-turns
# 2 pi for good measure.
import numpy as np


def gains(omega, zeta):
    w = 2 * np.pi * omega
    return np.array([w**2, 2 * zeta * w])
