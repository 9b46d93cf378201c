"""Mistakes made with a finished answer, whatever function it came from.

Each `redo` takes the right answer: any, R, (n, 3, 3), or T, (n, 4, 4).
"""

from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from labkit.judge.matrices import pose, rigid_inverse, split
from labkit.judge.mistake import REDONE, Mistake, told
from robo47.checks import Array

Change = Callable[[Array], Any]


def _parts(R: Change = np.asarray, t: Change = np.asarray) -> Change:
    """Return the change that a pose undergoes when its parts do."""
    return lambda T: pose(R(split(T)[0]), t(split(T)[1]))


def _mirrored(R: Array) -> Array:
    return R * [1.0, 1.0, -1.0]


def _in_last_row(T: Array) -> Array:
    out = _parts(t=np.zeros_like)(T)
    out[..., 3, :3] = T[..., :3, 3]
    return out


def _below(T: Array, row: float) -> Array:
    out = T.copy()
    out[..., 3, :] = row
    return out


def _mistakes(text: str, redo: Mapping[str, Change]) -> list[Mistake]:
    """Return mistakes of a text with a line of each, as `told` reads it."""
    lines = told(text)
    return [Mistake(slug, says, redo[slug], its or REDONE) for slug, says, its in lines]


GENERAL = _mistakes(
    """
    all-signs: every sign is wrong => its negative
    whole-numbers: only whole numbers are left: an array of integers cuts off what is
      stored in it => the right one cut to whole numbers
    transposed: the matrix is transposed => its transpose
    reshaped: its transpose is reshaped, which only counts the numbers off anew; rows
      become columns by .T => its transpose, reshaped
    rows-swapped: the rows are (v; omega); omega's three come first => the right one
      with its rows swapped
    inverse: it is the inverse, which says how much is known; a covariance says how
      little => its inverse
    sigma-for-variance: its entries are sigma, and a covariance holds sigma squared =>
      the root of each entry
    halves-swapped: the two halves are swapped: {halves[0]} comes first, then
      {halves[1]} => the right one with its halves swapped
    blocks-swapped: its blocks are in the order (v; omega); omega's three come first
      => the right one with its blocks swapped
    counted-from-one: the places are counted from 1; an index counts them from 0 => the
      right one and 1
    one-too-small: it is one too small: the place before the right one
    inverted: True and False are swapped => the right one turned round
    row-first: a pixel is (column, row), x before y; here the row comes first => the
      right one with its two columns swapped
    """,
    {
        "all-signs": np.negative,
        "whole-numbers": np.trunc,
        "transposed": np.matrix_transpose,
        "reshaped": lambda M: np.swapaxes(M, -1, -2).reshape(M.shape),
        "rows-swapped": lambda J: np.roll(J, 3, axis=-2),
        "inverse": lambda P: np.linalg.inv(P),
        "sigma-for-variance": lambda P: np.sign(P) * np.sqrt(np.abs(P)),
        "halves-swapped": lambda answer: np.roll(answer, 3, axis=-1),
        "blocks-swapped": lambda P: np.roll(P, (3, 3), axis=(-2, -1)),
        "counted-from-one": lambda answer: answer + 1.0,
        "one-too-small": lambda answer: answer - 1.0,
        "inverted": lambda answer: 1.0 - answer,
        "row-first": lambda answer: answer[..., ::-1],
    },
)


def general(*slugs: str, **words: Any) -> list[Mistake]:
    """Return mistakes by their names; words are those that their sentences ask for."""
    known = {mistake.slug: mistake for mistake in GENERAL}
    return [replace(known[s], says=known[s].says.format(**words)) for s in slugs]


OF_A_ROTATION = [
    *_mistakes(
        """
        R-transposed: the matrix is right except that it is transposed: it turns the
          other way => its transpose
        left-handed: the third axis points the wrong way: det R = -1, a left-handed
          frame => the right one with that axis reversed
        all-signs: every entry has the wrong sign => its negative
        """,
        {
            "R-transposed": np.matrix_transpose,
            "left-handed": _mirrored,
            "all-signs": np.negative,
        },
    ),
    *general("whole-numbers"),
]
_OF_A_POSE = _mistakes(
    """
    R-transposed: all is right except that R is transposed: T[:3, :3] {wrong_way} => the
      right one with R transposed
    inverse-returned: this is the inverse of what was asked for: it {wrong_way} => its
      inverse
    T-transposed: the whole 4x4 is transposed, so its bottom row is not (0, 0, 0, 1) =>
      its transpose
    t-in-last-row: the translation is in the last row, and the last column is empty =>
      the right one with t moved there
    corner-zero: the bottom row is (0, 0, 0, 0): points lose their 1, and so every move
      after this one
    ones-below: the bottom row is all ones, not (0, 0, 0, 1)
    t-lost: the rotation is right, but the translation is missing => the right one
      without t
    R-lost: the translation is right, but there is no rotation: R is the identity => the
      right one without R
    t-negated: the rotation is right, but the translation has the wrong sign => the
      right one with t negated
    left-handed: the third axis points the wrong way: det R = -1, a left-handed frame =>
      the right one with that axis reversed
    millimetres: the rotation is right, but the translation is in millimetres => the
      right one in millimetres
    """,
    {
        "R-transposed": _parts(R=np.matrix_transpose),
        "inverse-returned": rigid_inverse,
        "T-transposed": np.matrix_transpose,
        "t-in-last-row": _in_last_row,
        "corner-zero": partial(_below, row=0.0),
        "ones-below": partial(_below, row=1.0),
        "t-lost": _parts(t=np.zeros_like),
        "R-lost": _parts(R=lambda R: np.broadcast_to(np.eye(3), R.shape)),
        "t-negated": _parts(t=np.negative),
        "left-handed": _parts(R=_mirrored),
        "millimetres": _parts(t=lambda t: 1000.0 * t),
    },
)


def of_a_pose(wrong_way: str = "turns the other way") -> list[Mistake]:
    """Return mistakes made with a finished pose.

    Args:
        wrong_way: what its R does when transposed: "maps the world to the hand".
    """
    said = [replace(m, says=m.says.format(wrong_way=wrong_way)) for m in _OF_A_POSE]
    return [*said, *general("whole-numbers")]
