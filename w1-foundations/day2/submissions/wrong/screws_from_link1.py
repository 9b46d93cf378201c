# task 2.5: v-off
# The points are measured from link1.
import numpy as np


def screw_axis(axis, point):
    return np.hstack([axis, -np.cross(axis, point)])


def joint_screws(T_zero):
    return np.array([screw_axis(T[:3, 2], T[:3, 3] - T_zero[0][:3, 3]) for T in T_zero])
