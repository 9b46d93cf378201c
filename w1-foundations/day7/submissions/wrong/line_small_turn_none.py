# task 7.6: small-turn-for-none (not in a run: none of its turns is small)
# Under 1e-6 rad it does not turn.
import numpy as np

from robo47 import jacobian, screws, se3


def interpolate_pose(T0, T1, s):
    R0, p0 = T0[:3, :3], T0[:3, 3]
    turn = jacobian.log_rotation(R0.T @ T1[:3, :3])
    angle = np.linalg.norm(turn)
    if angle < 1e-6:
        return se3.make_T(R0, p0 + s * (T1[:3, 3] - p0))
    R = R0 @ screws.exp_rotation(turn / angle, s * angle)
    return se3.make_T(R, p0 + s * (T1[:3, 3] - p0))
