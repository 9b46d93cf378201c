# task 1.1: whole-numbers
# An integer identity cuts off whatever is stored in it.
import numpy as np


def make_T(R, t):
    T = np.eye(4, dtype=int)
    T[:3, :3] = R
    T[:3, 3] = t
    return T
