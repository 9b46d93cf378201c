# task 5.8: one-limit-for-all
# 87 for all.
import numpy as np


def saturate(tau, limits):
    return np.clip(tau, -limits[0], limits[0])
