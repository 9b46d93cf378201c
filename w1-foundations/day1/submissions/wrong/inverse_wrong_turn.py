# task 1.3: t-turned-forwards
# t is turned by R where it has to be turned back.
import numpy as np


def inverse(T):
    R, t = T[:3, :3], T[:3, 3]
    out = np.eye(4)
    out[:3, :3] = R.T
    out[:3, 3] = -R @ t
    return out
