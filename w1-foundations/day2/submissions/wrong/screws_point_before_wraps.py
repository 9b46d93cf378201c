# task 2.5: previous-links-point
# Index -1 for the first joint.
import numpy as np


def screw_axis(axis, point):
    return np.hstack([axis, -np.cross(axis, point)])


def joint_screws(T_zero):
    rows = [screw_axis(T_zero[i][:3, 2], T_zero[i - 1][:3, 3]) for i in range(7)]
    return np.array(rows)
