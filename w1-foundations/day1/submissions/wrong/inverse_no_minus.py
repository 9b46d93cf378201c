# task 1.3: t-negated
# The minus got lost.
import numpy as np


def inverse(T):
    out = np.eye(4)
    out[:3, :3] = T[:3, :3].T
    out[:3, 3] = out[:3, :3] @ T[:3, 3]
    return out
