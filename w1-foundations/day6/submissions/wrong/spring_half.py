# task 6.5: half-a-spring
# The 1/2 of the energy.
import numpy as np


def spring_wrench(e, V_err, K, D):
    return 0.5 * K @ e + D @ V_err
