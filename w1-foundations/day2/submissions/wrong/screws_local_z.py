# task 2.5: axis-local-z
# z in the link's own frame.
import numpy as np


def joint_screws(T_zero):
    rows = []
    for T in T_zero:
        axis, point = np.array([0.0, 0.0, 1.0]), T[:3, 3]
        rows.append(np.hstack([axis, -np.cross(axis, point)]))
    return np.array(rows)
