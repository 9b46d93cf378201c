# task 46.2: kept-between-calls
# One array for all calls, added to.
import numpy as np


def cross(a, b, out=np.zeros(3)):
    out += np.cross(a, b)
    return out.copy()
