"""Mistakes in tasks 3.3 and 3.4: `log_rotation(R)` and `pose_error(T, T_goal)`.

`redo` takes rotations (n, 3, 3), or two lists of poses (n, 4, 4).
"""

from collections.abc import Callable
from typing import Any

import numpy as np

from robo47 import jacobian, se3
from robo47.checks import Array
from robo47.diagnose import Case, Finding
from robo47.diagnose.compare import difference
from robo47.diagnose.matrices import split, times, transposed
from robo47.diagnose.mistake import Mistake, lifted

Function = Callable[..., Any]
BY_PI = 0.02  # radians: "near pi" begins here


def sine_axis(R: Array) -> Array:
    """Return vee(R - R^T) / 2, (n, 3): the axis times the sine."""
    K = 0.5 * (R - transposed(R))
    return np.stack([K[..., 2, 1], K[..., 0, 2], K[..., 1, 0]], axis=-1)


def quaternion_part(R: Array) -> Array:
    """Return the axis times the sine of half the angle, (n, 3)."""
    q = se3.R_to_quat(R)
    return q[..., 1:] * np.where(q[..., :1] < 0.0, -1.0, 1.0)


def _unit(R: Array) -> Array:
    w = jacobian.log_rotation(R)
    size = np.linalg.norm(w, axis=-1, keepdims=True)
    return np.divide(w, size, out=np.zeros_like(w), where=size > 0.0)


def _arcsine(R: Array) -> Array:
    """Return the axis times arcsin of the sine: never more than a quarter turn."""
    a = sine_axis(R)
    sine = np.linalg.norm(a, axis=-1, keepdims=True)
    angle = np.arcsin(np.clip(sine, 0.0, 1.0))
    return a * np.divide(angle, sine, out=np.ones_like(sine), where=sine > 0.0)


def _half(R: Array) -> Array:
    return 0.5 * jacobian.log_rotation(R)


LOG = [
    Mistake(
        "sine-for-angle",
        "its length is the sine of the angle, not the angle: the axis is still to be "
        "scaled",
        sine_axis,
        "the axis times the sine",
    ),
    Mistake(
        "twice-the-sine",
        "its length is twice the sine of the angle: the half is missing, and so is the "
        "angle",
        lambda R: 2.0 * sine_axis(R),
        "the entries of R - R^T",
    ),
    Mistake(
        "quaternion-vector-part",
        "this is the vector part of the quaternion: its length is sin(angle / 2)",
        quaternion_part,
        "that vector part",
    ),
    Mistake(
        "twice-the-quaternion-part",
        "this is twice the vector part of the quaternion: it is like the angle only "
        "near 0",
        lambda R: 2.0 * quaternion_part(R),
        "twice that vector part",
    ),
    Mistake(
        "axis-only",
        "its length is 1 (the axis); it has to be the angle",
        _unit,
        "the axis alone",
    ),
    Mistake(
        "arcsine",
        "the angle is right up to 90 degrees only: an arcsine cannot tell 100 degrees "
        "from 80, for which the trace is needed",
        _arcsine,
        "the axis times the arcsine",
    ),
    Mistake(
        "half-the-angle",
        "its length is half the angle, as in a quaternion",
        _half,
        "half of it",
    ),
    Mistake(
        "in-degrees",
        "the angle is in degrees; here it is in radians",
        lambda R: np.rad2deg(jacobian.log_rotation(R)),
        "the answer in degrees",
    ),
]


def where_the_angle_fails(case: Case) -> Finding | None:
    """Return that the answer is right but near 0, or but near pi."""
    angle = np.linalg.norm(case.T, axis=1)
    off = difference(case.S, case.T) > 1e-5
    by_pi, by_0 = angle > np.pi - BY_PI, angle < BY_PI
    if not off.any() or off[~by_pi & ~by_0].any():
        return None
    if off[by_pi].any():
        i = np.flatnonzero(off & by_pi)[0]
        says = (
            f"It is right, but not near pi: {np.pi - angle[i]:.0e} below it, it is off"
        )
        return Finding(
            "wrong-near-pi",
            f"{says} by {np.abs(case.S[i] - case.T[i]).max():.2g}. The sine is nearly "
            f"0 "
            "there, and cannot be divided by.",
        )
    return Finding("wrong-near-0", "It is right, but not for angles near 0.")


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
