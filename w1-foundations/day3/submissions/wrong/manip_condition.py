# task 3.7: inverse-condition
# 1 over the condition number.
import numpy as np


def manipulability(J):
    return 1 / np.linalg.cond(J)
