"""Mistakes in task 3.3: `log_rotation(R)`.

`redo` takes rotations, (n, 3, 3).
"""

from collections.abc import Callable
from typing import Any

import numpy as np

from labkit.judge.matrices import transposed
from labkit.judge.mistake import Mistake, each
from robo47 import jacobian, se3
from robo47.checks import Array

Function = Callable[..., Any]


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


def roll_pitch_yaw(R: Array) -> Array:
    """Return the angles about x, y and z of R = Rz(yaw) Ry(pitch) Rx(roll), (n, 3)."""
    roll = np.arctan2(R[..., 2, 1], R[..., 2, 2])
    pitch = -np.arcsin(np.clip(R[..., 2, 0], -1.0, 1.0))
    yaw = np.arctan2(R[..., 1, 0], R[..., 0, 0])
    return np.stack([roll, pitch, yaw], axis=-1)


def _cosine(R: Array) -> Array:
    return (np.trace(R, axis1=-2, axis2=-1) - 1.0) / 2.0


def _twice_the_sine_in_atan2(R: Array) -> Array:
    a = 2.0 * sine_axis(R)
    sine = np.linalg.norm(a, axis=-1)
    return _unit(R) * np.arctan2(sine, _cosine(R))[..., None]


@each
def _textbook(R: Array) -> Array:
    """Return the formula of most books as it is typed, to the last digit."""
    a = np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]])
    angle = np.arccos((np.trace(R) - 1) / 2)
    return angle / (2 * np.sin(angle)) * a


def _nan_where(which: Function) -> Function:
    """Return the right answers, but NaN for some rotations."""

    def redo(R: Array) -> Array:
        return np.where(which(R)[..., None], np.nan, jacobian.log_rotation(R))

    return redo


LOG = [
    Mistake(
        "sine-for-angle",
        "the vector's length is the sine of the angle; it has to be the angle",
        sine_axis,
        "the axis times the sine",
    ),
    Mistake(
        "twice-the-sine",
        "the vector's length is twice the sine of the angle: the half is missing, and "
        "so is the angle",
        lambda R: 2.0 * sine_axis(R),
        "the vector of the entries of R - R^T",
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
    Mistake(
        "roll-pitch-yaw",
        "these are the angles of three turns about x, y and z, one after the other; "
        "one turn about one axis is asked for",
        roll_pitch_yaw,
        "the vector (roll, pitch, yaw)",
    ),
    Mistake(
        "twice-the-sine-in-atan2",
        "the angle comes from twice the sine: the half of (R - R^T) / 2 is missing",
        _twice_the_sine_in_atan2,
        "the axis times atan2 of twice the sine",
    ),
]
# With NaN in them; for `log_rotation` alone.
NOT_FINITE = [
    Mistake(
        "textbook-formula",
        "this is the formula of most books, theta / (2 sin theta) times R - R^T: no "
        "turn is 0 / 0 in it, and near pi it divides noise by nearly 0",
        _textbook,
        "that formula, with its NaN,",
    ),
    Mistake(
        "nan-at-0",
        "NaN comes back where R is the identity: there it is divided by a sine of 0",
        _nan_where(lambda R: np.linalg.norm(sine_axis(R), axis=-1) == 0.0),
        "the right one with NaN there",
    ),
    Mistake(
        "arccosine-beyond-1",
        "NaN comes back where rounding makes (trace - 1) / 2 a bit more than 1, or "
        "less than -1: the arccosine has no answer there. atan2 always has one",
        _nan_where(lambda R: np.abs(_cosine(R)) > 1.0),
        "the right one with NaN there",
    ),
]
