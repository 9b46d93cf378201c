# task 7.6: passed
# The library of the days before.
import numpy as np

from robo47 import jacobian, screws


def straight_pose(T0, T1, s):
    w = jacobian.log_rotation(T0[:3, :3].T @ T1[:3, :3])
    angle = np.linalg.norm(w)
    T = T0.copy()
    if angle > 0:
        T[:3, :3] = T0[:3, :3] @ screws.exp_rotation(w / angle, s * angle)
    T[:3, 3] += s * (T1 - T0)[:3, 3]
    return T
