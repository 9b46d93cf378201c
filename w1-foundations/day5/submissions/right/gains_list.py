# task 5.2: passed
# A plain list.
import numpy as np


def gains(omega, zeta):
    return [omega * omega, 2 * omega * zeta]
