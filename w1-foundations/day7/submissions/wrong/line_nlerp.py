# task 7.6: nlerp
# Quaternions, straight and normalised.
import numpy as np

from robo47 import se3


def straight_pose(T0, T1, s):
    a, b = se3.R_to_quat(T0[:3, :3]), se3.R_to_quat(T1[:3, :3])
    if a @ b < 0:
        b = -b
    T = np.eye(4)
    T[:3, :3] = se3.quat_to_R((1 - s) * a + s * b)
    T[:3, 3] = (1 - s) * T0[:3, 3] + s * T1[:3, 3]
    return T
