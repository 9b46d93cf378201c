# task 2.5: moment-forgotten
# The bottom row for the last column.
import numpy as np


def joint_screws(T_zero):
    rows = []
    for T in T_zero:
        axis, point = T[:3, 2], T[3, :3]
        rows.append(np.hstack([axis, -np.cross(axis, point)]))
    return np.array(rows)
