# task 2.1: outer-product
# The outer product.
import numpy as np


def skew(w):
    return np.outer(w, w)
