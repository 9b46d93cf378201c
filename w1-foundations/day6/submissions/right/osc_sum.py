# task 6.3: passed
# With einsum, and bias first.
import numpy as np


def osc_torque(J, Lambda, bias, site_bias, acc):
    F = np.einsum("ij,j->i", Lambda, acc - site_bias)
    return bias + np.einsum("ij,i->j", J, F)
