# task 7.6: passed
# Slerp of quaternions.
import numpy as np

from robo47 import se3


def straight_pose(T0, T1, s):
    a, b = se3.R_to_quat(T0[:3, :3]), se3.R_to_quat(T1[:3, :3])
    if a @ b < 0:
        b = -b
    angle = np.arctan2(np.linalg.norm(b - (a @ b) * a), a @ b)
    if angle < 1e-12:
        quat = a
    else:
        quat = np.sin((1 - s) * angle) * a + np.sin(s * angle) * b
    return se3.make_T(se3.quat_to_R(quat), (1 - s) * T0[:3, 3] + s * T1[:3, 3])
