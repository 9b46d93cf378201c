# task 7.6: wrong-near-0 (not in a run: none of its turns is small)
# A small turn is made at once.
import numpy as np

from robo47 import jacobian, screws, se3


def interpolate_pose(T0, T1, s):
    R0, R1, p0 = T0[:3, :3], T1[:3, :3], T0[:3, 3]
    turn = jacobian.log_rotation(R0.T @ R1)
    angle = np.linalg.norm(turn)
    R = R1 if angle < 0.05 else R0 @ screws.exp_rotation(turn / angle, s * angle)
    return se3.make_T(R, p0 + s * (T1[:3, 3] - p0))
