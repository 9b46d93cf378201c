# task 2.5: axis-x-column
# The first column.
import numpy as np


def joint_screws(T_zero):
    rows = []
    for T in T_zero:
        axis, point = T[:3, 0], T[:3, 3]
        rows.append(np.hstack([axis, -np.cross(axis, point)]))
    return np.array(rows)
