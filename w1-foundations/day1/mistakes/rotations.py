"""Mistakes in tasks 1.2 `Rz(theta)` and 1.4 `quat_to_R(quat)`."""

from collections.abc import Callable
from typing import Any

import numpy as np

from labkit.judge.finished import OF_A_ROTATION
from labkit.judge.mistake import Mistake, applied
from robo47 import se3
from robo47.checks import Array


def _from_cos_sin(rows: Callable[[Array, Array], list[list[Any]]]) -> Callable:
    """Return a function of theta from rows of c, s, 0 and 1."""

    def redo(theta: Array) -> Array:
        table = rows(np.cos(theta), np.sin(theta))
        cells = [[np.broadcast_to(cell, theta.shape) for cell in row] for row in table]
        return np.moveaxis(np.array(cells), (0, 1), (-2, -1))

    return redo


RZ = [
    Mistake(
        "turns-backwards",
        "it turns the wrong way: a positive angle takes x towards -y",
        lambda theta: se3.Rz(-theta),
        "Rz(-theta)",
    ),
    Mistake(
        "radians-taken-for-degrees",
        "the angle is in radians already, and is converted from degrees once more",
        lambda theta: se3.Rz(np.deg2rad(theta)),
        "the turn by pi / 180 times the angle",
    ),
    Mistake(
        "degrees-into-cos",
        "cos and sin are given degrees; they expect radians, as the angle comes",
        lambda theta: se3.Rz(np.rad2deg(theta)),
        "the turn by 180 / pi times the angle",
    ),
    Mistake(
        "turns-about-x", "this turns about x, not about z", se3.Rx, "that turn about x"
    ),
    Mistake(
        "turns-about-y", "this turns about y, not about z", se3.Ry, "that turn about y"
    ),
    Mistake(
        "turns-about-x",
        "this turns about x, and backwards",
        lambda theta: se3.Rx(-theta),
        "that turn about x",
    ),
    Mistake(
        "turns-about-y",
        "this turns about y, and backwards",
        lambda theta: se3.Ry(-theta),
        "that turn about y",
    ),
    Mistake(
        "sin-and-cos-swapped",
        "sin and cos have changed places: at 0 it already turns",
        _from_cos_sin(
            lambda c, s: [
                [
                    s,
                    -c,
                    0,
                ],
                [c, s, 0],
                [0, 0, 1],
            ]
        ),
        "the right one with the two swapped",
    ),
    Mistake(
        "minus-missing",
        "one of the two sines needs a minus: as it is, lengths change (R R^T is not I)",
        _from_cos_sin(lambda c, s: [[c, s, 0], [s, c, 0], [0, 0, 1]]),
        "the right one without that minus",
    ),
    Mistake(
        "minus-twice",
        "only one of the two sines has a minus: as it is, lengths change",
        _from_cos_sin(lambda c, s: [[c, -s, 0], [-s, c, 0], [0, 0, 1]]),
        "the right one with both negated",
    ),
    Mistake(
        "reflection",
        "a cosine has a minus that belongs to a sine: this mirrors (det R = -1)",
        _from_cos_sin(lambda c, s: [[c, s, 0], [s, -c, 0], [0, 0, 1]]),
        "the right one with that sign",
    ),
    Mistake(
        "z-lost",
        "whatever is along z disappears: the last entry is 0, so det R = 0",
        _from_cos_sin(lambda c, s: [[c, -s, 0], [s, c, 0], [0, 0, 0]]),
        "the right one with a 0 there",
    ),
    Mistake(
        "half-angle",
        "it turns by half of the angle",
        lambda theta: se3.Rz(theta / 2),
        "the turn by half of it",
    ),
    Mistake(
        "double-angle",
        "it turns by twice the angle",
        lambda theta: se3.Rz(2 * theta),
        "the turn by twice as much",
    ),
    *(
        Mistake(
            "angle-rounded",
            f"the angle is rounded to {decimals} decimals before it is used",
            lambda theta, decimals=decimals: se3.Rz(
                np.array([round(float(x), decimals) for x in theta])
            ),
            "the turn by the rounded angle",
        )
        for decimals in (0, 1, 2, 3, 4)
    ),
    *applied(OF_A_ROTATION, se3.Rz),
]


def _plain(quat: Array) -> Array:
    """Return 1 - 2 (yy + zz) and so on, without normalising first."""
    w, x, y, z = np.moveaxis(quat, -1, 0)
    rows = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]
    return np.moveaxis(np.array(rows), (0, 1), (-2, -1))


def _length(quat: Array) -> Array:
    return np.linalg.norm(quat, axis=-1, keepdims=True)


def _squares(quat: Array) -> Array:
    """Return ww + xx - yy - zz and so on, without normalising first."""
    return _length(quat)[..., None] ** 2 * se3.quat_to_R(quat)


# The two usual formulas; of a unit quaternion both give the same.
UNNORMALISED = (_plain, _squares)


def _half(quat: Array) -> Array:
    """Return the turn by half the angle."""
    unturned = np.array([1.0, 0.0, 0.0, 0.0])
    return se3.quat_to_R(quat / _length(quat) + unturned)


def _factor_two_missing(quat: Array) -> Array:
    R = _plain(quat / _length(quat))
    return (R + np.eye(3)) / 2


NOT_NORMALISED = (
    "the quaternion is used as it comes, but only one of length 1 stands for a turn: "
    "(1, 1, 0, 0) has length 1.41"
)

QUAT_TO_R = [
    Mistake(
        "wxyz-read-as-xyzw",
        "the quaternion is read as (x, y, z, w); here, as in MuJoCo, w comes first",
        lambda quat: se3.quat_to_R(np.roll(quat, 1, axis=-1)),
        "the right one read with w last",
    ),
    Mistake(
        "xyzw-rolled-wrongly",
        "w is not the only number that moved: the four are rolled the wrong way round",
        lambda quat: se3.quat_to_R(quat[..., [2, 3, 0, 1]]),
        "the right one read as y, z, w, x",
    ),
    *(
        Mistake(
            "not-normalised",
            NOT_NORMALISED,
            formula,
            "the right formula without normalising",
        )
        for formula in UNNORMALISED
    ),
    *(
        Mistake(
            "xyzw-and-not-normalised",
            "two things: the quaternion is read as (x, y, z, w), where w comes first; "
            "and it is not normalised before it is used",
            lambda quat, formula=formula: formula(np.roll(quat, 1, axis=-1)),
            "the formula with both",
        )
        for formula in UNNORMALISED
    ),
    Mistake(
        "divided-by-length-squared",
        "the quaternion is divided by its squared length; the square root is missing",
        lambda quat: _plain(quat / _length(quat) ** 2),
        "the right formula with that division",
    ),
    Mistake(
        "half-angle",
        "it turns by half the angle: w is the cosine of half the angle",
        _half,
        "the turn by half of it",
    ),
    Mistake(
        "factor-two-missing",
        "the products are there, but the factor 2 in front of them is missing",
        _factor_two_missing,
        "the right formula without the 2",
    ),
    Mistake(
        "z-before-x",
        "x, y and z are read in the order z, y, x",
        lambda quat: se3.quat_to_R(quat[..., [0, 3, 2, 1]]),
        "the right one read as w, z, y, x",
    ),
    *applied(OF_A_ROTATION, se3.quat_to_R),
]
