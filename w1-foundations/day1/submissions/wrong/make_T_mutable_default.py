# task 1.1: one-array-for-all
# The default T is one array for all calls.
import numpy as np


def make_T(R, t, T=np.eye(4)):  # noqa: B008 (the mistake)
    T[:3, :3] = R
    T[:3, 3] = t
    return T
