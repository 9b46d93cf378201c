"""7.6 `interpolate_pose(T0, T1, s)`: its questions and its mistakes."""

from functools import partial

import numpy as np

from labkit.judge import Pose, Row
from robo47 import se3
from robo47.jacobian import log_rotation
from robo47.screws import exp_rotation, exp_screw, skew
from robo47.trajectory import interpolate_pose

from .turns import TURNS


def one_way(T0, T1, s):
    """Return whether the smaller angle is below pi; at pi both senses are correct."""
    return np.trace(T0[:3, :3].T @ T1[:3, :3]) > -1.0 + 1e-6


row = Row(Pose(), held_out=TURNS, at_edge=one_way)


@row.inputs
def _(rng):
    yield np.eye(4), se3.make_T(np.eye(3), np.array([0.4, 0.0, 0.2])), 0.5
    T0, T1 = rng.poses(9), rng.poses(9)
    s = [0.0, 1.0, *rng.numbers(0.05, 0.95, 7).tolist()]
    yield from zip(T0, T1, s, strict=True)


def exp(w):
    """Return the rotation matrix of a rotation vector."""
    angle = np.linalg.norm(w)
    return exp_rotation(w / angle, angle) if angle > 0 else np.eye(3)


def nlerp(R0, R1, s):
    """Return the normalised weighted mean of two quaternions as a rotation matrix."""
    a, b = se3.R_to_quat(R0), se3.R_to_quat(R1)
    return se3.quat_to_R((1 - s) * a + s * (b if a @ b >= 0 else -b))


def nearest(M):
    """Return the rotation matrix nearest to a matrix, by its singular vectors."""
    U, _, Vt = np.linalg.svd(M)
    return U @ Vt


def line(T0, T1, s, turn):
    """Return the pose at s of the straight line, with the orientation turn()."""
    T = np.eye(4)
    T[:3, :3] = turn()
    T[:3, 3] = T0[:3, 3] + s * (T1[:3, 3] - T0[:3, 3])
    return T


@row.wrongs
def _(T0, T1, s):
    """by-entries: your code interpolates the entries of R0 and R1 linearly, so the
      result between the two ends is in general not a rotation matrix. Multiply the
      angle of the rotation from R0 to R1 by s instead
    entries-made-a-rotation: your orientation is the rotation matrix nearest to the
      linear interpolation of R0 and R1, so the angular velocity is not constant.
      Multiply the angle of the rotation from R0 to R1 by s instead
    nlerp: your orientation is the normalised linear interpolation of the two
      quaternions, so the angular velocity is not constant. Multiply the angle of the
      rotation from R0 to R1 by s instead
    turn-in-world-axes: your orientation is R0 times a rotation about the axis of R1
      R0^T. This axis is expressed in the world frame, so the rotation should multiply
      R0 from the left
    turn-on-the-left: your orientation is a rotation about the axis of R0^T R1, times
      R0. This axis is expressed in the frame of T0, so the rotation should multiply R0
      from the right
    turn-backwards: your orientation rotates by the correct angle, but in the opposite
      direction. Check the order of the factors in the rotation from R0 to R1, and the
      sign of the angle
    logarithms-mixed: your orientation is the linear interpolation of the rotation
      vectors of R0 and R1. Multiply the rotation vector of the rotation from R0 to R1
      by s instead, because rotations about different axes do not add
    not-turned: your code returns the orientation R0 for every s. The orientation should
      change from R0 at s = 0 to R1 at s = 1
    turned-at-once: your code returns the orientation R1 for every s. Multiply the angle
      of the rotation from R0 to R1 by s instead
    """
    R0, R1 = T0[:3, :3], T1[:3, :3]
    w0 = log_rotation(R0)
    turns = {
        "by-entries": lambda: R0 + s * (R1 - R0),
        "entries-made-a-rotation": lambda: nearest(R0 + s * (R1 - R0)),
        "nlerp": lambda: nlerp(R0, R1, s),
        "turn-in-world-axes": lambda: R0 @ exp(s * log_rotation(R1 @ R0.T)),
        "turn-on-the-left": lambda: exp(s * log_rotation(R0.T @ R1)) @ R0,
        "turn-backwards": lambda: R0 @ exp(s * log_rotation(R1.T @ R0)),
        "logarithms-mixed": lambda: exp(w0 + s * (log_rotation(R1) - w0)),
        "not-turned": lambda: R0,
        "turned-at-once": lambda: R1,
    }
    return {slug: partial(line, T0, T1, s, turn) for slug, turn in turns.items()}


@row.wrong
def screw_motion(T0, T1, s):
    """your code follows the screw motion from T0 to T1, so the origin moves along a
    curve. Interpolate the position along a straight line instead"""
    T = se3.inverse(T0) @ T1
    w = log_rotation(T[:3, :3])
    p = T[:3, 3]
    theta = np.linalg.norm(w)
    if theta < 1e-12:
        return T0 @ se3.make_T(np.eye(3), s * p)
    K = skew(w / theta)
    G = theta * np.eye(3) + (1 - np.cos(theta)) * K + (theta - np.sin(theta)) * K @ K
    return T0 @ exp_screw(np.append(w / theta, np.linalg.solve(G, p)), s * theta)


@row.wrong
def way_in_the_first_frame(T0, T1, s):
    """your code rotates the displacement p1 - p0 by R0. Use the displacement unchanged,
    because both positions are already expressed in the world frame"""
    p0, p1 = T0[:3, 3], T1[:3, 3]
    R = interpolate_pose(T0, T1, s)[:3, :3]
    return se3.make_T(R, p0 + s * T0[:3, :3] @ (p1 - p0))


@row.right  # Slerp of quaternions.
def _(T0, T1, s):
    a, b = se3.R_to_quat(T0[:3, :3]), se3.R_to_quat(T1[:3, :3])
    b = b if a @ b >= 0 else -b  # the nearer one of two equal quaternions
    angle = np.arctan2(np.linalg.norm(b - (a @ b) * a), a @ b)
    q = np.sin((1 - s) * angle) * a + np.sin(s * angle) * b if angle > 1e-12 else a
    t = (1 - s) * T0[:3, 3] + s * T1[:3, 3]  # the origin
    return se3.make_T(se3.quat_to_R(q), t)


@row.close("float32")  # Single precision at the end.
def _(T0, T1, s):
    return interpolate_pose(T0, T1, s).astype(np.float32)


row.at_least_0(s="a fraction of the path, from 0 to 1")


row.spans(  # as small, or as large, as in the lab
    s=(2e-05,),
)
