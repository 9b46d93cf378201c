"""Mistakes in task 7.6 `straight_pose(T0, T1, s)`."""

from collections.abc import Callable

import numpy as np

from labkit.judge.matrices import transposed
from labkit.judge.mistake import Mistake, each
from robo47 import jacobian, screws, se3, trajectory
from robo47.checks import Array

Turn = Callable[[Array, Array, float], Array]


def _exp(w: Array) -> Array:
    angle = float(np.linalg.norm(w))
    axis = w / angle if angle > 0 else np.array([0.0, 0.0, 1.0])
    return screws.exp_rotation(axis, angle)


def _log(R: Array) -> Array:
    return jacobian.log_rotation(R)


def _straight(turn: Turn) -> Callable[..., Array]:
    """Return `straight_pose` with another rotation."""

    def one(T0: Array, T1: Array, s: float) -> Array:
        T = np.eye(4)
        T[:3, :3] = turn(T0[:3, :3], T1[:3, :3], s)
        T[:3, 3] = T0[:3, 3] + s * (T1[:3, 3] - T0[:3, 3])
        return T

    return each(one)


def _nlerp(R0: Array, R1: Array, s: float) -> Array:
    a, b = se3.R_to_quat(R0), se3.R_to_quat(R1)
    return se3.quat_to_R((1 - s) * a + s * (b if a @ b >= 0 else -b))


def _screw(T0: Array, T1: Array, s: float) -> Array:
    T = se3.inverse(T0) @ T1
    w, p = _log(T[:3, :3]), T[:3, 3]
    theta = float(np.linalg.norm(w))
    if theta < 1e-12:
        return T0 @ se3.make_T(np.eye(3), s * p)
    K = screws.skew(w / theta)
    G = theta * np.eye(3) + (1 - np.cos(theta)) * K + (theta - np.sin(theta)) * K @ K
    S = np.concatenate([w / theta, np.linalg.solve(G, p)])
    return T0 @ screws.exp_screw(S, s * theta)


def _moved(place: Callable[[Array, Array, Array], Array]) -> Callable[..., Array]:
    """Return `straight_pose` with another translation."""

    def redo(T0: Array, T1: Array, s: Array) -> Array:
        T = trajectory.straight_pose(T0, T1, s)
        T[:, :3, 3] = place(T0, T1, s[:, None])
        return T

    return redo


def _local(T0: Array, T1: Array, s: Array) -> Array:
    way = s * (T1[:, :3, 3] - T0[:, :3, 3])
    return T0[:, :3, 3] + (T0[:, :3, :3] @ way[..., None])[..., 0]


STRAIGHT = [
    Mistake(
        "by-entries",
        "R's entries go straight from the one to the other; on the way they are no "
        "rotation",
        _straight(lambda R0, R1, s: R0 + s * (R1 - R0)),
        "the mean of the entries",
    ),
    Mistake(
        "nlerp",
        "the quaternions go straight and are normalised: the same turn, but not at one "
        "rate",
        _straight(_nlerp),
        "the normalised mean of the quaternions",
    ),
    Mistake(
        "turn-in-world-axes",
        "the turn is written in world axes, R1 R0^T, but stands on the right of R0, "
        "where the first frame's own axes belong",
        _straight(lambda R0, R1, s: R0 @ _exp(s * _log(R1 @ R0.T))),
        "R0 exp(s log(R1 R0^T))",
    ),
    Mistake(
        "turn-on-the-left",
        "the turn is written in the first frame's axes, R0^T R1, but stands on the "
        "left of R0, where world axes belong",
        _straight(lambda R0, R1, s: _exp(s * _log(R0.T @ R1)) @ R0),
        "exp(s log(R0^T R1)) R0",
    ),
    Mistake(
        "turn-backwards",
        "it turns the other way: the logarithm is that of the way back",
        _straight(lambda R0, R1, s: R0 @ _exp(s * _log(R1.T @ R0))),
        "R0 exp(s log(R1^T R0))",
    ),
    Mistake(
        "start-forgotten",
        "the turn starts from the identity; it starts from R0",
        _straight(lambda R0, R1, s: _exp(s * _log(R0.T @ R1))),
        "exp(s log(R0^T R1))",
    ),
    Mistake(
        "goals-own-turn",
        "s times the logarithm of R1 alone: where it starts does not count",
        _straight(lambda R0, R1, s: R0 @ _exp(s * _log(R1))),
        "R0 exp(s log(R1))",
    ),
    Mistake(
        "logarithms-mixed",
        "the two logarithms go straight from the one to the other; rotations do not "
        "add up",
        _straight(lambda R0, R1, s: _exp(_log(R0) + s * (_log(R1) - _log(R0)))),
        "the exponential of their mean",
    ),
    Mistake(
        "not-turned",
        "the rotation stays that of the first pose",
        _straight(lambda R0, R1, s: R0),
        "R0",
    ),
    Mistake(
        "turned-at-once",
        "the rotation is that of the last pose from the start",
        _straight(lambda R0, R1, s: R1),
        "R1",
    ),
    Mistake(
        "whole-turn",
        "s is missing in the rotation: it is turned at once",
        _straight(lambda R0, R1, s: R0 @ _exp(_log(R0.T @ R1))),
        "R1",
    ),
    Mistake(
        "screw-motion",
        "this is the screw motion from the one to the other: its origin runs along an "
        "arc, not a line",
        each(_screw),
        "T0 exp(s log(T0^-1 T1))",
    ),
    Mistake(
        "way-in-the-first-frame",
        "the way is turned by R0; both positions are in the world already",
        _moved(_local),
        "p0 + s R0 (p1 - p0)",
    ),
    Mistake(
        "start-place-forgotten",
        "the way starts from the world's origin; it starts from p0",
        _moved(lambda T0, T1, s: s * (T1[:, :3, 3] - T0[:, :3, 3])),
        "s (p1 - p0)",
    ),
    Mistake(
        "goal-for-way",
        "the goal p1 stands where the way from p0 to p1 belongs",
        _moved(lambda T0, T1, s: T0[:, :3, 3] + s * T1[:, :3, 3]),
        "p0 + s p1",
    ),
    Mistake(
        "not-moved",
        "the position stays that of the first pose",
        _moved(lambda T0, T1, s: T0[:, :3, 3]),
        "p0",
    ),
    Mistake(
        "backwards",
        "it goes from the last pose to the first",
        lambda T0, T1, s: trajectory.straight_pose(T1, T0, s),
        "the way back",
    ),
    Mistake(
        "transposed",
        "the rotation is transposed",
        _straight(
            lambda R0, R1, s: transposed(R0 @ _exp(s * _log(R0.T @ R1))),
        ),
        "its transpose",
    ),
]
