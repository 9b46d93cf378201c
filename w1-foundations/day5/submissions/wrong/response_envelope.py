# task 5.3: envelope-alone
# Only the envelope.
import numpy as np


def error_response(t, omega, zeta):
    return np.exp(-zeta * omega * t)
