# task 6.5: spring-sign
# A spring that pushes.
import numpy as np


def spring_wrench(e, V_err, K, D):
    return -K @ e + D @ V_err
