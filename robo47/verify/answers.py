"""Answers of functions that are given, a lab's own: asked row by row, and judged.

Radians, metres; world axes.
"""

from collections.abc import Callable
from typing import Any

import mujoco
import numpy as np

from robo47 import jacobian, panda, screws, se3
from robo47.checks import Array
from robo47.fast.arm_state import HAT
from robo47.fast.vectors import times
from robo47.verify.oracle import (
    mujoco_poses,
    mujoco_rotation,
    mujoco_site_jacobian,
    random_q,
)

Function = Callable[..., Array]  # one of the lab's own
Check = Callable[[str, Array], None]  # is given a name and differences
SEED = 47  # the same random numbers at every run


def each(function: Callable[..., Any], *columns: Array) -> Array:
    """Return a function's answers to each row of its arguments.

    Args:
        function: takes one row of each column.
        columns: arguments, (n, ...) each.

    Returns:
        Answers, (n, ...).
    """
    return np.array([function(*row) for row in zip(*columns, strict=True)])


def _screws(n: int) -> tuple[Array, Array]:
    """Return n screws (omega; v), (n, 6), and angles from -pi to pi, (n,).

    Every fourth is a slide, with omega = 0; the others turn, and most have a pitch.
    """
    rng = np.random.default_rng(SEED)
    S = rng.normal(size=(n, 6))
    S[:, :3] /= np.linalg.norm(S[:, :3], axis=1, keepdims=True)
    S[::4, :3] = 0.0
    return S, rng.uniform(-np.pi, np.pi, n)


def off_cross(skew: Function, n: int) -> Array:
    """Return how far [a] b is from the cross product, (n, 3), of random a and b."""
    a, b = np.random.default_rng(SEED).normal(size=(2, n, 3))
    return times(each(skew, a), b) - np.cross(a, b)


def off_rotation(exp_rotation: Function, n: int) -> Array:
    """Return how far rotations about random axes are from MuJoCo's, (n, 3, 3)."""
    S, theta = _screws(2 * n)
    given = S[1::2, :3], theta[1::2]  # no slides
    return each(exp_rotation, *given) - each(mujoco_rotation, *given)


def off_motion(exp_screw: Function, n: int) -> Array:
    """Return how far motions along random screws are from the library's, (n, 4, 4)."""
    given = _screws(n)
    return each(exp_screw, *given) - screws.exp_screw(*given)


def off_adjoint(adjoint: Function, T: Array) -> Array:
    """Return how far screws told by Ad(T) are from T [S] inv(T), (n, 4, 4).

    Args:
        adjoint: of a pose, (6, 6).
        T: poses, (n, 4, 4).
    """
    S, _ = _screws(len(T))
    told = times(each(adjoint, T), S)
    seen, own = ((rows @ HAT).reshape(-1, 4, 4) for rows in (told, S))  # [S]
    return seen - T @ own @ se3.inverse(T)


def off_log(log_rotation: Function, n: int) -> Array:
    """Return how far the logarithms of n known turns are off, (n, 3).

    Some are next to 0, or next to pi down to 1e-9 rad; one is half a turn about y.

    Args:
        log_rotation: of a rotation matrix, (3,).
        n: how many.
    """
    rng = np.random.default_rng(SEED)
    axes = rng.normal(size=(n, 3))
    axes /= np.linalg.norm(axes, axis=1, keepdims=True)
    angles = np.pi * rng.uniform(size=n)
    angles[:12] = [0.0, 1e-9, 1e-5, *(np.pi - 10.0 ** -np.arange(1, 10))]
    axes[12] = [0.0, 1.0, 0.0]
    angles[12] = np.pi
    R = screws.exp_rotation(axes, angles)
    R[12] = np.round(R[12])  # exactly: there both signs mean the same
    return each(log_rotation, R) - angles[:, None] * axes


def off_goal(pose_error: Function, T: Array, goal: Array) -> Array:
    """Return how far from its goal a hand is that was moved by its error.

    Args:
        pose_error: rotation vector and translation from T to a goal, (6,).
        T: poses, (n, 4, 4).
        goal: poses, (n, 4, 4).

    Returns:
        Differences of the upper three rows of the poses, (n, 3, 4).
    """
    e = each(pose_error, T, goal)
    moved = T.copy()
    angle = np.linalg.norm(e[:, :3], axis=1)
    turns = angle > 0  # not where it is NaN
    axes = e[turns, :3] / angle[turns, None]
    moved[turns, :3, :3] = screws.exp_rotation(axes, angle[turns]) @ T[turns, :3, :3]
    moved[:, :3, 3] += e[:, 3:]
    return (moved - goal)[:, :3]


def off_least_squares(dls_step: Function, J: Array) -> Array:
    """Return how far damped steps are from those of numpy.linalg.lstsq, (n, 7).

    With seven more rows, damping times the identity, |J dq - e|^2 + damping^2 |dq|^2 is
    a plain sum of squares.

    Args:
        dls_step: of J, e and the damping, (7,).
        J: Jacobians, (n, 6, 7); singular ones are welcome.
    """
    e = np.random.default_rng(SEED).normal(size=(len(J), 6))
    damping = np.resize([0.05, 1.0], len(J))
    rows = np.concatenate([J, damping[:, None, None] * np.eye(7)], axis=1)
    right = np.hstack([e, np.zeros((len(J), 7))])
    truth = each(lambda A, b: np.linalg.lstsq(A, b)[0], rows, right)
    return each(dls_step, J, e, damping) - truth


def off_null_vector(null_step: Function, J: Array) -> Array:
    """Return how far unfelt motions are from those along the null vector, (n, 7).

    Args:
        null_step: of J and a motion of the joints, (7,).
        J: Jacobians of rank 6, (n, 6, 7).
    """
    dq = np.random.default_rng(SEED).normal(size=(len(J), 7))
    null = np.linalg.svd(J)[2][:, 6]
    along = np.sum(dq * null, axis=1, keepdims=True) * null
    return each(null_step, J, dq) - along


def off_volume(manipulability: Callable[..., Any], J: Array) -> Array:
    """Return how far manipulability squared is from det(J J^T), (n,)."""
    return each(manipulability, J) ** 2 - np.linalg.det(J @ np.swapaxes(J, 1, 2))


def in_the_hand(J_site: Array, T: Array) -> Array:
    """Return Jacobians with both halves turned into the hand's axes, (n, 6, 7).

    Args:
        J_site: in world axes, (n, 6, 7).
        T: `T_world_ee`, (n, 4, 4).
    """
    back = np.swapaxes(T[:, :3, :3], 1, 2)
    return np.concatenate([back @ J_site[:, :3], back @ J_site[:, 3:]], axis=1)


def off_library(model: mujoco.MjModel, n: int) -> tuple[Array, Array]:
    """Return how far the library's poses and J_site are from MuJoCo's.

    Args:
        model: of the Panda without its hand.
        n: number of random configurations.

    Returns:
        Differences, (n, 4, 4) and (n, 6, 7).
    """
    q = random_q(model, n, SEED)
    S = panda.screws(model)
    T = screws.fk_space(S, panda.home_pose(model), q)
    J = jacobian.space_jacobian(S, q)
    J_site = jacobian.site_jacobian(J, T[:, :3, 3])
    truth = mujoco_poses(model, q)[panda.END_FRAME["panda_nohand"]]
    return T - truth, J_site - mujoco_site_jacobian(model, q)
