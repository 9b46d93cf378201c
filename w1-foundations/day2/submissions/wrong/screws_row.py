# task 2.5: axis-row-not-column
# The third row.
import numpy as np


def joint_screws(T_zero):
    rows = []
    for T in T_zero:
        axis, point = T[2, :3], T[:3, 3]
        rows.append(np.hstack([axis, -np.cross(axis, point)]))
    return np.array(rows)
