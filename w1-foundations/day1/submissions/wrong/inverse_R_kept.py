# task 1.3: R-kept
# The transpose is used for t, but not stored.
import numpy as np


def inverse(T):
    R, t = T[:3, :3], T[:3, 3]
    out = np.eye(4)
    out[:3, :3] = R
    out[:3, 3] = -R.T @ t
    return out
