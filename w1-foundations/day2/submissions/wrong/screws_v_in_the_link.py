# task 2.5: v-off
# v is turned into the link's axes.
import numpy as np


def screw_axis(axis, point):
    return np.hstack([axis, -np.cross(axis, point)])


def joint_screws(T_zero):
    return np.array(
        [
            np.hstack([T[:3, 2], T[:3, :3].T @ -np.cross(T[:3, 2], T[:3, 3])])
            for T in T_zero
        ]
    )
