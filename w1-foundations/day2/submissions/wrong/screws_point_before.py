# task 2.5: previous-links-point
# The joint is taken to be at the end of the link before.
import numpy as np


def screw_axis(axis, point):
    return np.hstack([axis, -np.cross(axis, point)])


def joint_screws(T_zero):
    return np.array(
        [
            screw_axis(T_zero[i][:3, 2], T_zero[max(i - 1, 0)][:3, 3])
            for i in range(len(T_zero))
        ]
    )
