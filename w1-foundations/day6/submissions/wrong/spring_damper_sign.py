# task 6.5: damper-sign
# The damper of a book where V is the hand's own.
import numpy as np


def spring_wrench(e, V_err, K, D):
    return K @ e - D @ V_err
