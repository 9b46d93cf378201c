"""Mistakes made with a finished answer, whatever function it came from.

Each `redo` takes the right answer: any, R, (n, 3, 3), or T, (n, 4, 4).
"""

from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from labkit.judge.matrices import pose, rigid_inverse, split
from labkit.judge.mistake import Mistake, told
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
    return [Mistake(slug, says, redo[slug]) for slug, says, _ in lines]


GENERAL = _mistakes(
    """
    all-signs: every entry of your result has the wrong sign
    whole-numbers: your code truncates the result to whole numbers, because your array
      has an integer dtype. Create an array of floats instead
    transposed: your matrix is transposed
    reshaped: your code reshapes the array instead of transposing it. Use .T, which
      exchanges rows and columns
    rows-swapped: your rows are in the order (v; omega). The rows of omega should come
      first
    inverse: your result is the information matrix, which is the inverse of the
      covariance. Return the covariance itself
    sigma-for-variance: your code returns the square root of each entry of the
      covariance. Return the entries themselves, which are variances and covariances
    halves-swapped: the two halves of your result are swapped. The first half should be
      {halves[0]}, and the second half should be {halves[1]}
    blocks-swapped: your blocks are in the order (v; omega). The angular block
      should come first
    counted-from-one: your index is counted from 1 instead of 0
    one-too-small: your index is too small by 1
    inverted: your code swaps True and False
    row-first: your code puts the row first. A pixel is (x, y), so the column comes
      first
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
        R-transposed: your matrix is transposed, so it rotates in the opposite direction
        left-handed: the third column of your rotation matrix has the wrong sign, so the
          frame is left-handed (det R = -1)
        all-signs: every entry of your matrix has the wrong sign
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
    R-transposed: your translation is correct, but your rotation matrix T[:3, :3] is
      transposed, so it {wrong_way}
    inverse-returned: your result is the inverse of the correct pose, so it {wrong_way}
    T-transposed: your whole 4x4 matrix is transposed, so the translation is in its
      bottom row
    t-in-last-row: your translation is in the last row instead of the last column
    corner-zero: your bottom row is (0, 0, 0, 0) instead of (0, 0, 0, 1)
    ones-below: your bottom row is (1, 1, 1, 1) instead of (0, 0, 0, 1)
    t-lost: your rotation is correct, but your code omits the translation
    R-lost: your translation is correct, but your rotation matrix is always the identity
      matrix
    t-negated: your rotation is correct, but your translation has the wrong sign
    left-handed: the third column of your rotation matrix has the wrong sign, so the
      frame is left-handed (det R = -1)
    millimetres: your rotation is correct, but your translation is in millimetres. It
      should be in metres
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


def of_a_pose(wrong_way: str = "rotates in the opposite direction") -> list[Mistake]:
    """Return mistakes made with a finished pose.

    Args:
        wrong_way: what its R does when transposed: "maps the world to the hand".
    """
    said = [replace(m, says=m.says.format(wrong_way=wrong_way)) for m in _OF_A_POSE]
    return [*said, *general("whole-numbers")]
