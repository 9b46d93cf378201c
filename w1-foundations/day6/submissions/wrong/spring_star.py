# task 6.5: shape
# * for @.
import numpy as np


def impedance_wrench(e, V_err, K, D):
    return K * e + D * V_err
