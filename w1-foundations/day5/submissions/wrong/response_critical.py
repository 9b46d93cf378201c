# task 5.3: one-formula-for-all
# zeta = 1 is all one needs.
import numpy as np


def error_response(t, omega, zeta):
    return (1 + omega * t) * np.exp(-omega * t)
