# task 1.2: minus-missing
# Both sines are positive.
from math import cos, sin

import numpy as np


def Rz(theta):
    return np.array(
        [[cos(theta), sin(theta), 0], [sin(theta), cos(theta), 0], [0, 0, 1]]
    )
