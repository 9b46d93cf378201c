# task 3.4: sine-for-angle
# Half the sum of the columns' cross products, a known shortcut: the sine.
import numpy as np


def pose_error(T, T_goal):
    R, G = T[:3, :3], T_goal[:3, :3]
    w = 0.5 * (
        np.cross(R[:, 0], G[:, 0])
        + np.cross(R[:, 1], G[:, 1])
        + np.cross(R[:, 2], G[:, 2])
    )
    return np.concatenate([w, T_goal[:3, 3] - T[:3, 3]])
