# task 5.8: not-bounded
# MuJoCo does it anyway.
import numpy as np


def saturate(tau, limits):
    return tau.copy()
