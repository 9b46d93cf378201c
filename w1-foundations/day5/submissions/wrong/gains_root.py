# task 5.2: root-of-omega
# 2 zeta sqrt(kp) with omega for kp.
import numpy as np


def gains(omega, zeta):
    return np.array([omega**2, 2 * zeta * np.sqrt(omega)])
