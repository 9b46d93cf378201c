"""Mistakes made with a finished answer, whatever function it came from.

Each `redo` takes the right answer: any, R, (n, 3, 3), or T, (n, 4, 4).
"""

from collections.abc import Callable

import numpy as np

from labkit.judge.matrices import pose, rigid_inverse, split
from labkit.judge.mistake import Mistake
from robo47.checks import Array

NEGATED = Mistake("all-signs", "every sign is wrong", np.negative, "its negative")
TRUNCATED = Mistake(
    "whole-numbers",
    "only whole numbers are left: an array of integers cuts off what is stored in it",
    np.trunc,
    "the right one cut to whole numbers",
)

Change = Callable[[Array], Array]


def _same(part: Array) -> Array:
    return part


def _parts(R: Change = _same, t: Change = _same) -> Change:
    """Return the change that a pose undergoes when its parts do."""
    return lambda T: pose(R(split(T)[0]), t(split(T)[1]))


def _mirrored(R: Array) -> Array:
    return R * [1.0, 1.0, -1.0]


def _nothing(part: Array) -> Array:
    return np.zeros_like(part)


def _unturned(R: Array) -> Array:
    return np.broadcast_to(np.eye(3), R.shape)


def _in_last_row(T: Array) -> Array:
    out = _parts(t=_nothing)(T)
    out[..., 3, :3] = T[..., :3, 3]
    return out


def _corner_zero(T: Array) -> Array:
    out = T.copy()
    out[..., 3, 3] = 0.0
    return out


def _ones_below(T: Array) -> Array:
    out = T.copy()
    out[..., 3, :] = 1.0
    return out


OF_A_ROTATION = [
    Mistake(
        "R-transposed",
        "the matrix is right except that it is transposed: it turns the other way",
        np.matrix_transpose,
        "its transpose",
    ),
    Mistake(
        "left-handed",
        "the third axis points the wrong way: det R = -1, a left-handed frame",
        _mirrored,
        "the right one with that axis reversed",
    ),
    Mistake("all-signs", "every entry has the wrong sign", np.negative, "its negative"),
    TRUNCATED,
]


def of_a_pose(wrong_way: str = "turns the other way") -> list[Mistake]:
    """Return mistakes made with a finished pose.

    Args:
        wrong_way: what its R does when transposed: "maps the world to the hand".
    """
    return [
        Mistake(
            "R-transposed",
            f"all is right except that R is transposed: T[:3, :3] {wrong_way}",
            _parts(R=np.matrix_transpose),
            "the right one with R transposed",
        ),
        Mistake(
            "inverse-returned",
            f"this is the inverse of what was asked for: it {wrong_way}",
            rigid_inverse,
            "its inverse",
        ),
        Mistake(
            "T-transposed",
            "the whole 4x4 is transposed, so its bottom row is not (0, 0, 0, 1)",
            np.matrix_transpose,
            "its transpose",
        ),
        Mistake(
            "t-in-last-row",
            "the translation is in the last row, and the last column is empty",
            _in_last_row,
            "the right one with t moved there",
        ),
        Mistake(
            "corner-zero",
            "the bottom row is (0, 0, 0, 0): points lose their 1, and so every move "
            "after this one",
            _corner_zero,
        ),
        Mistake(
            "ones-below", "the bottom row is all ones, not (0, 0, 0, 1)", _ones_below
        ),
        Mistake(
            "t-lost",
            "the rotation is right, but the translation is missing",
            _parts(t=_nothing),
            "the right one without t",
        ),
        Mistake(
            "R-lost",
            "the translation is right, but there is no rotation: R is the identity",
            _parts(R=_unturned),
            "the right one without R",
        ),
        Mistake(
            "t-negated",
            "the rotation is right, but the translation has the wrong sign",
            _parts(t=np.negative),
            "the right one with t negated",
        ),
        Mistake(
            "left-handed",
            "the third axis points the wrong way: det R = -1, a left-handed frame",
            _parts(R=_mirrored),
            "the right one with that axis reversed",
        ),
        Mistake(
            "millimetres",
            "the rotation is right, but the translation is in millimetres",
            _parts(t=lambda t: 1000.0 * t),
            "the right one in millimetres",
        ),
        TRUNCATED,
    ]
