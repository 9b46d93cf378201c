# task 7.6: wrong-at-pi (not in a run: none of its turns is half a turn)
# Near pi the roots of the diagonal, all positive.
import numpy as np

from robo47 import screws, se3


def log(R):
    w = np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]]) / 2
    sine, cosine = np.linalg.norm(w), (np.trace(R) - 1) / 2
    angle = np.arctan2(sine, cosine)
    if np.pi - angle < 1e-5:
        return angle * np.sqrt(np.maximum((np.diag(R) + 1) / 2, 0))
    return angle * w / sine if sine > 0 else w


def interpolate_pose(T0, T1, s):
    R0, R1, p0, p1 = T0[:3, :3], T1[:3, :3], T0[:3, 3], T1[:3, 3]
    turn = log(R0.T @ R1)
    angle = np.linalg.norm(turn)
    axis = turn / angle if angle > 0 else np.array([0.0, 0.0, 1.0])
    return se3.make_T(R0 @ screws.exp_rotation(axis, s * angle), p0 + s * (p1 - p0))
