# task 6.5: damper-forgotten
# A spring that rings for ever.
import numpy as np


def spring_wrench(e, V_err, K, D):
    return K @ e
