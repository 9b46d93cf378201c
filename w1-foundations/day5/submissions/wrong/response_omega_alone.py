# task 5.3: envelope-of-omega
# e^(-omega t).
import numpy as np


def error_response(t, omega, zeta):
    return np.exp(-omega * t)
