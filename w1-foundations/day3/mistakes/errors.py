"""Mistakes in task 3.4: `pose_error(T, T_goal)`.

`redo` takes two lists of poses, (n, 4, 4).
"""

from collections.abc import Callable
from typing import Any

import numpy as np

from labkit.judge.matrices import rigid_inverse, split, times, transposed
from labkit.judge.mistake import Mistake, lifted
from robo47 import jacobian
from robo47.checks import Array
from robo47.screws import skew

from .logs import LOG, roll_pitch_yaw

Function = Callable[..., Any]


def error(T: Array, T_goal: Array, log: Function = jacobian.log_rotation) -> Array:
    """Return the pose error, (n, 6), with another logarithm."""
    (R, p), (R_goal, p_goal) = split(T), split(T_goal)
    return np.concatenate([log(R_goal @ transposed(R)), p_goal - p], axis=-1)


def _rotation(change: Function) -> Function:
    """Return the error with another rotation half, made from R and R_goal."""

    def redo(T: Array, T_goal: Array) -> Array:
        e = error(T, T_goal)
        e[:, :3] = change(T[:, :3, :3], T_goal[:, :3, :3])
        return e

    return redo


def in_the_hands_axes(T: Array, T_goal: Array) -> Array:
    """Return the error as the hand sees it, (n, 6): both halves turned by R^T."""
    e, back = error(T, T_goal), transposed(T[:, :3, :3])
    return np.concatenate([times(back, e[:, :3]), times(back, e[:, 3:])], axis=-1)


def screw_log(D: Array) -> Array:
    """Return the twist whose exponential is a pose, (n, 6): [omega] and V^-1 p."""
    R, p = split(D)
    w = jacobian.log_rotation(R)
    theta = np.linalg.norm(w, axis=-1)[:, None, None]
    safe = np.where(theta > 1e-6, theta, 1.0)
    factor = np.where(
        theta > 1e-6, (1.0 - 0.5 * safe / np.tan(0.5 * safe)) / safe**2, 1.0 / 12.0
    )
    K = skew(w)
    return np.concatenate([w, times(np.eye(3) - 0.5 * K + factor * K @ K, p)], axis=-1)


def _translation(change: Function) -> Function:
    def redo(T: Array, T_goal: Array) -> Array:
        e = error(T, T_goal)
        e[:, 3:] = change(T, T_goal, e[:, 3:])
        return e

    return redo


_log = jacobian.log_rotation
POSE_ERROR = [
    Mistake(
        "in-the-hands-axes",
        "both halves are in the hand's axes; here they are in the world's",
        in_the_hands_axes,
        "the error turned by R^T",
    ),
    Mistake(
        "rotation-in-the-hands-axes",
        "the rotation is in the hand's axes: this is log(R^T R_goal), which does not "
        "go with J_site",
        _rotation(lambda R, goal: _log(transposed(R) @ goal)),
        "the error with log(R^T R_goal)",
    ),
    Mistake(
        "rotation-sign",
        "the rotation leads from the goal to the hand, the translation from the hand "
        "to the goal",
        _rotation(lambda R, goal: _log(R @ transposed(goal))),
        "the error with log(R R_goal^T)",
    ),
    Mistake(
        "rotation-difference",
        "rotation vectors are subtracted: log(R_goal) - log(R) is no rotation that "
        "leads from one to the other",
        _rotation(lambda R, goal: _log(goal) - _log(R)),
        "the difference of the two logs",
    ),
    Mistake(
        "euler-difference",
        "roll, pitch and yaw are subtracted: their difference is no rotation that "
        "leads from one to the other",
        _rotation(lambda R, goal: roll_pitch_yaw(goal) - roll_pitch_yaw(R)),
        "the difference of those angles",
    ),
    Mistake(
        "body-twist",
        "this is the body twist, log(T^-1 T_goal) of Modern Robotics: it goes with "
        "J_body, but here the error has to go with J_site",
        lambda T, T_goal: screw_log(rigid_inverse(T) @ T_goal),
        "the body twist",
    ),
    Mistake(
        "space-twist",
        "this is the twist log(T_goal T^-1): it goes with J_space, and its v is no "
        "difference of positions; here the error has to go with J_site",
        lambda T, T_goal: screw_log(T_goal @ rigid_inverse(T)),
        "that twist",
    ),
    Mistake(
        "rotations-multiplied",
        "this is log(R_goal R): one of the two has to be undone",
        _rotation(lambda R, goal: _log(goal @ R)),
        "the error with log(R_goal R)",
    ),
    Mistake(
        "translation-sign",
        "the translation leads from the goal to the hand",
        _translation(lambda T, T_goal, d: -d),
        "the error with p - p_goal",
    ),
    Mistake(
        "translation-in-the-hands-axes",
        "the translation is in the hand's axes (the last column of T^-1 T_goal); here "
        "it is in the world's",
        _translation(lambda T, T_goal, d: times(transposed(T[:, :3, :3]), d)),
        "the error with R^T (p_goal - p)",
    ),
    Mistake(
        "goal-position-for-translation",
        "the lower half is where the goal is, not how far it is",
        _translation(lambda T, T_goal, d: T_goal[:, :3, 3]),
        "the error with p_goal",
    ),
    Mistake(
        "screw-for-translation",
        "the lower half is the translation of T_goal T^-1, which is p_goal - R p with "
        "the rotation between them as R; here it is p_goal - p",
        _translation(
            lambda T, T_goal, d: (
                T_goal[:, :3, 3]
                - times(
                    T_goal[:, :3, :3] @ transposed(T[:, :3, :3]),
                    T[:, :3, 3],
                )
            )
        ),
        "the error with that translation",
    ),
    *lifted(
        LOG,
        "in the rotation, ",
        lambda log: lambda T, T_goal: error(T, T_goal, log),
    ),
]
