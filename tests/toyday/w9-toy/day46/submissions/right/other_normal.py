# task 46.6: passed
# Another right answer.
import numpy as np


def normal(v):
    n = np.cross(v, [0.3, -0.5, 0.8])
    return -n / np.linalg.norm(n)
