# task 2.5: passed
# All joints at once.
import numpy as np


def joint_screws(T_zero):
    z, p = T_zero[:, :3, 2], T_zero[:, :3, 3]
    return np.hstack([z, np.cross(p, z)])
