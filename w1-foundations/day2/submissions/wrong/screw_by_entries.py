# task 2.3: product-by-entries
# A product of entries.
import numpy as np


def screw_axis(axis, point):
    return np.hstack([axis, -axis * point])
