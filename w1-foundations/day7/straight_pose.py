"""7.6 `straight_pose(T0, T1, s)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Pose, draw
from labkit.judge.row import Row
from robo47 import se3
from robo47.jacobian import log_rotation
from robo47.screws import exp_rotation, exp_screw, skew
from robo47.trajectory import straight_pose

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
    T0, T1 = draw.poses(rng, 9), draw.poses(rng, 9)
    s = [0.0, 1.0, *draw.numbers(rng, 0.05, 0.95, 7).tolist()]
    yield from zip(T0, T1, s, strict=True)


def exp(w):
    """Return the rotation of a rotation vector."""
    angle = np.linalg.norm(w)
    return exp_rotation(w / angle, angle) if angle > 0 else np.eye(3)


def line(T0, T1, s, R):
    """Return the pose at s of the straight line, with another rotation."""
    T = np.eye(4)
    T[:3, :3] = R
    T[:3, 3] = T0[:3, 3] + s * (T1[:3, 3] - T0[:3, 3])
    return T


def at(T0, T1, s, p):
    """Return the pose at s of the right turn, at another place."""
    return se3.make_T(straight_pose(T0, T1, s)[:3, :3], p)


@row.wrong
def by_entries(T0, T1, s):
    """R's entries go straight from the one to the other; on the way they are no
    rotation => the mean of the entries"""
    R0, R1 = T0[:3, :3], T1[:3, :3]
    return line(T0, T1, s, R0 + s * (R1 - R0))


@row.wrong
def nlerp(T0, T1, s):
    """the quaternions go straight and are normalised: the same turn, but not at one
    rate => the normalised mean of the quaternions"""
    a, b = se3.R_to_quat(T0[:3, :3]), se3.R_to_quat(T1[:3, :3])
    b = b if a @ b >= 0 else -b
    return line(T0, T1, s, se3.quat_to_R((1 - s) * a + s * b))


@row.wrong
def turn_in_world_axes(T0, T1, s):
    """the turn is written in world axes, R1 R0^T, but stands on the right of R0, where
    the first frame's own axes belong => R0 exp(s log(R1 R0^T))"""
    R0, R1 = T0[:3, :3], T1[:3, :3]
    return line(T0, T1, s, R0 @ exp(s * log_rotation(R1 @ R0.T)))


@row.wrong
def turn_on_the_left(T0, T1, s):
    """the turn is written in the first frame's axes, R0^T R1, but stands on the left of
    R0, where world axes belong => exp(s log(R0^T R1)) R0"""
    R0, R1 = T0[:3, :3], T1[:3, :3]
    return line(T0, T1, s, exp(s * log_rotation(R0.T @ R1)) @ R0)


@row.wrong
def turn_backwards(T0, T1, s):
    """it turns the other way: the logarithm is that of the way back => R0 exp(s
    log(R1^T R0))"""
    R0, R1 = T0[:3, :3], T1[:3, :3]
    return line(T0, T1, s, R0 @ exp(s * log_rotation(R1.T @ R0)))


@row.wrong
def start_forgotten(T0, T1, s):
    """the turn starts from the identity; it starts from R0 => exp(s log(R0^T R1))"""
    R0, R1 = T0[:3, :3], T1[:3, :3]
    return line(T0, T1, s, exp(s * log_rotation(R0.T @ R1)))


@row.wrong
def goals_own_turn(T0, T1, s):
    """s times the logarithm of R1 alone: where it starts does not count => R0 exp(s
    log(R1))"""
    R0, R1 = T0[:3, :3], T1[:3, :3]
    return line(T0, T1, s, R0 @ exp(s * log_rotation(R1)))


@row.wrong
def logarithms_mixed(T0, T1, s):
    """the two logarithms go straight from the one to the other; rotations do not add up
    => the exponential of their mean"""
    w0, w1 = log_rotation(T0[:3, :3]), log_rotation(T1[:3, :3])
    return line(T0, T1, s, exp(w0 + s * (w1 - w0)))


@row.wrong
def not_turned(T0, T1, s):
    """the rotation stays that of the first pose => R0"""
    return line(T0, T1, s, T0[:3, :3])


@row.wrong
def turned_at_once(T0, T1, s):
    """the rotation is that of the last pose from the start => R1"""
    return line(T0, T1, s, T1[:3, :3])


@row.wrong
def whole_turn(T0, T1, s):
    """s is missing in the rotation: it is turned at once => R1"""
    R0, R1 = T0[:3, :3], T1[:3, :3]
    return line(T0, T1, s, R0 @ exp(log_rotation(R0.T @ R1)))


@row.wrong
def screw_motion(T0, T1, s):
    """this is the screw motion from the one to the other: its origin runs along an arc,
    not a line => T0 exp(s log(T0^-1 T1))"""
    T = se3.inverse(T0) @ T1
    w, p = log_rotation(T[:3, :3]), T[:3, 3]
    theta = np.linalg.norm(w)
    if theta < 1e-12:
        return T0 @ se3.make_T(np.eye(3), s * p)
    K = skew(w / theta)
    G = theta * np.eye(3) + (1 - np.cos(theta)) * K + (theta - np.sin(theta)) * K @ K
    return T0 @ exp_screw(np.append(w / theta, np.linalg.solve(G, p)), s * theta)


@row.wrong
def way_in_the_first_frame(T0, T1, s):
    """the way is turned by R0; both positions are in the world already => p0 + s R0 (p1
    - p0)"""
    p0, p1 = T0[:3, 3], T1[:3, 3]
    return at(T0, T1, s, p0 + s * T0[:3, :3] @ (p1 - p0))


@row.wrong
def start_place_forgotten(T0, T1, s):
    """the way starts from the world's origin; it starts from p0 => s (p1 - p0)"""
    p0, p1 = T0[:3, 3], T1[:3, 3]
    return at(T0, T1, s, s * (p1 - p0))


@row.wrong
def goal_for_way(T0, T1, s):
    """the goal p1 stands where the way from p0 to p1 belongs => p0 + s p1"""
    p0, p1 = T0[:3, 3], T1[:3, 3]
    return at(T0, T1, s, p0 + s * p1)


@row.wrong
def not_moved(T0, T1, s):
    """the position stays that of the first pose => p0"""
    return at(T0, T1, s, T0[:3, 3])


@row.wrong
def backwards(T0, T1, s):
    """it goes from the last pose to the first => the way back"""
    return straight_pose(T1, T0, s)


@row.wrong
def transposed(T0, T1, s):
    """the rotation is transposed => its transpose"""
    return line(T0, T1, s, straight_pose(T0, T1, s)[:3, :3].T)


@row.right  # Slerp of quaternions.
def _(T0, T1, s):
    a, b = se3.R_to_quat(T0[:3, :3]), se3.R_to_quat(T1[:3, :3])
    b = b if a @ b >= 0 else -b
    angle = np.arctan2(np.linalg.norm(b - (a @ b) * a), a @ b)
    q = np.sin((1 - s) * angle) * a + np.sin(s * angle) * b if angle > 1e-12 else a
    return se3.make_T(se3.quat_to_R(q), (1 - s) * T0[:3, 3] + s * T1[:3, 3])


@row.right  # The turn in world axes, on the left.
def _(T0, T1, s):
    R0, R1 = T0[:3, :3], T1[:3, :3]
    return line(T0, T1, s, exp(s * log_rotation(R1 @ R0.T)) @ R0)


@row.close("float32")  # Single precision at the end.
def _(T0, T1, s):
    return straight_pose(T0, T1, s).astype(np.float32)
