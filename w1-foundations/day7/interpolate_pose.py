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
    """Return whether the shorter turn is one: after half a turn there are two."""
    return np.trace(T0[:3, :3].T @ T1[:3, :3]) > -1.0 + 1e-6


# One thing with two names: the whole rotation at once is that of the last pose.
ALIKE = [{"whole-turn", "turned-at-once"}]
row = Row(Pose(), held_out=TURNS, alike=ALIKE, at_edge=one_way)


@row.inputs
def _(rng):
    yield np.eye(4), se3.make_T(np.eye(3), np.array([0.4, 0.0, 0.2])), 0.5
    T0, T1 = rng.poses(9), rng.poses(9)
    s = [0.0, 1.0, *rng.numbers(0.05, 0.95, 7).tolist()]
    yield from zip(T0, T1, s, strict=True)


def exp(w):
    """Return the rotation of a rotation vector."""
    angle = np.linalg.norm(w)
    return exp_rotation(w / angle, angle) if angle > 0 else np.eye(3)


def nlerp(R0, R1, s):
    """Return the normalised mean of two quaternions as a rotation."""
    a, b = se3.R_to_quat(R0), se3.R_to_quat(R1)
    return se3.quat_to_R((1 - s) * a + s * (b if a @ b >= 0 else -b))


def nearest(M):
    """Return the rotation that is nearest to a matrix, by its singular vectors."""
    U, _, Vt = np.linalg.svd(M)
    return U @ Vt


def line(T0, T1, s, turn):
    """Return the pose at s of the straight line, turned by a function's rotation."""
    T = np.eye(4)
    T[:3, :3] = turn()
    T[:3, 3] = T0[:3, 3] + s * (T1[:3, 3] - T0[:3, 3])
    return T


@row.wrongs
def _(T0, T1, s):
    """by-entries: R's entries go straight from the one to the other; on the way they
      are no rotation => the mean of the entries
    entries-made-a-rotation: R's entries go straight, and the nearest rotation is taken:
      the same turn, but not at one rate => the rotation nearest to the mean
    nlerp: the quaternions go straight and are normalised: the same turn, but not at one
      rate => the normalised mean of the quaternions
    turn-in-world-axes: the turn is written in world axes, R1 R0^T, but stands on the
      right of R0, where the first frame's own axes belong => R0 exp(s log(R1 R0^T))
    turn-on-the-left: the turn is written in the first frame's axes, R0^T R1, but stands
      on the left of R0, where world axes belong => exp(s log(R0^T R1)) R0
    turn-backwards: it turns the other way: the logarithm is that of the way back => R0
      exp(s log(R1^T R0))
    start-forgotten: the turn starts from the identity; it starts from R0 => exp(s
      log(R0^T R1))
    goals-own-turn: s times the logarithm of R1 alone: where it starts does not count =>
      R0 exp(s log(R1))
    logarithms-mixed: the two logarithms go straight from the one to the other;
      rotations do not add up => the exponential of their mean
    not-turned: the rotation stays that of the first pose => R0
    turned-at-once: the rotation is that of the last pose from the start => R1
    whole-turn: s is missing in the rotation: it is turned at once => R1
    transposed: the rotation is transposed => its transpose
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
        "start-forgotten": lambda: exp(s * log_rotation(R0.T @ R1)),
        "goals-own-turn": lambda: R0 @ exp(s * log_rotation(R1)),
        "logarithms-mixed": lambda: exp(w0 + s * (log_rotation(R1) - w0)),
        "not-turned": lambda: R0,
        "turned-at-once": lambda: R1,
        "whole-turn": lambda: R0 @ exp(log_rotation(R0.T @ R1)),
        "transposed": lambda: interpolate_pose(T0, T1, s)[:3, :3].T,
    }
    return {slug: partial(line, T0, T1, s, turn) for slug, turn in turns.items()}


@row.wrong
def screw_motion(T0, T1, s):
    """this is the screw motion from the one to the other: its origin runs along an arc,
    not a line => T0 exp(s log(T0^-1 T1))"""
    T = se3.inverse(T0) @ T1
    w = log_rotation(T[:3, :3])
    p = T[:3, 3]
    theta = np.linalg.norm(w)
    if theta < 1e-12:
        return T0 @ se3.make_T(np.eye(3), s * p)
    K = skew(w / theta)
    G = theta * np.eye(3) + (1 - np.cos(theta)) * K + (theta - np.sin(theta)) * K @ K
    return T0 @ exp_screw(np.append(w / theta, np.linalg.solve(G, p)), s * theta)


@row.wrongs
def _(T0, T1, s):
    """way-in-the-first-frame: the way is turned by R0; both positions are in the world
      already => p0 + s R0 (p1 - p0)
    start-place-forgotten: the way starts from the world's origin; it starts from p0 =>
      s (p1 - p0)
    goal-for-way: the goal p1 stands where the way from p0 to p1 belongs => p0 + s p1
    not-moved: the position stays that of the first pose => p0
    backwards: it goes from the last pose to the first => the way back
    """
    p0, p1 = T0[:3, 3], T1[:3, 3]
    right = interpolate_pose(T0, T1, s)
    places = {
        "way-in-the-first-frame": p0 + s * T0[:3, :3] @ (p1 - p0),
        "start-place-forgotten": s * (p1 - p0),
        "goal-for-way": p0 + s * p1,
        "not-moved": p0,
    }
    found = {slug: se3.make_T(right[:3, :3], p) for slug, p in places.items()}
    return {**found, "backwards": interpolate_pose(T1, T0, s)}


@row.right  # Slerp of quaternions.
def _(T0, T1, s):
    a, b = se3.R_to_quat(T0[:3, :3]), se3.R_to_quat(T1[:3, :3])
    b = b if a @ b >= 0 else -b
    angle = np.arctan2(np.linalg.norm(b - (a @ b) * a), a @ b)
    q = np.sin((1 - s) * angle) * a + np.sin(s * angle) * b if angle > 1e-12 else a
    return se3.make_T(se3.quat_to_R(q), (1 - s) * T0[:3, 3] + s * T1[:3, 3])


@row.close("float32")  # Single precision at the end.
def _(T0, T1, s):
    return interpolate_pose(T0, T1, s).astype(np.float32)


row.at_least_0(s="a share of the way, from 0 to 1")


row.spans(  # as small, or as large, as in the lab
    s=(2e-05,),
)
