# task 2.5: first-link-for-all
# The loop's variable is not used.
import numpy as np


def joint_screws(T_zero):
    axis, point = T_zero[0, :3, 2], T_zero[0, :3, 3]
    return np.array([np.r_[axis, -np.cross(axis, point)] for _ in range(7)])
