# task 6.5: spring-forgotten
# A damper alone.
import numpy as np


def spring_wrench(e, V_err, K, D):
    return D @ V_err
