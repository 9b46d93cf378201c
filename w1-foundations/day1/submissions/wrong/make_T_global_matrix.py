# task 1.1: one-array-for-all
# One matrix at the top of the file is filled anew.
import numpy as np

EYE = np.eye(4)


def make_T(R, t):
    EYE[:3, :3] = R
    EYE[:3, 3] = t
    return EYE
