# task 7.7: passed
# Quarter turns taken off one by one.
import numpy as np


def grasp_pose(T_world_cube, above):
    x = T_world_cube[:2, 0].copy()
    for _ in range(3):
        if x[0] < abs(x[1]):
            x = np.array([x[1], -x[0]])
    z = np.array([0.0, 0.0, -1.0])
    T = np.eye(4)
    T[:2, 0] = x / np.linalg.norm(x)
    T[:3, 2] = z
    T[:3, 1] = np.cross(z, T[:3, 0])
    T[:3, 3] = T_world_cube[:3, 3]
    T[2, 3] += above
    return T
