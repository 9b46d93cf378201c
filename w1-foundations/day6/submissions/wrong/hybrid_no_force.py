# task 6.9: spring-everywhere
# force is not used.
import numpy as np


def hybrid_wrench(e, V_err, K, D, force):
    return K @ e + D @ V_err
