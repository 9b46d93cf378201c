# task 6.6: Lambda-ignored
# Every mass is taken to be 1 kg.
import numpy as np


def critical_damping(K, Lambda):
    return np.diag(2 * np.sqrt(K))
