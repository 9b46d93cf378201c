# task 7.7: turned-the-wrong-way
# The sine's entry from the wrong place.
import numpy as np


def grasp_pose(T_world_cube, above):
    yaw = np.arctan2(T_world_cube[0, 1], T_world_cube[0, 0])
    yaw -= np.pi / 2 * np.round(yaw / (np.pi / 2))
    c, s = np.cos(yaw), np.sin(yaw)
    T = np.diag([1.0, 1.0, -1.0, 1.0])
    T[:2, :2] = [[c, s], [s, -c]]
    T[:3, 3] = T_world_cube[:3, 3] + [0, 0, above]
    return T
