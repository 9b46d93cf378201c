"""Mistakes in tasks 1.1 `make_T(R, t)` and 1.3 `inverse(T)`."""

from collections.abc import Callable

import numpy as np

from labkit.judge.finished import of_a_pose
from labkit.judge.matrices import pose, rigid_inverse, split, times, transposed
from labkit.judge.mistake import Mistake, applied
from robo47.checks import Array

MAKE_T = [
    Mistake(
        "move-then-turn",
        "the translation comes out turned by R: you move first and turn after, "
        "where a pose turns first",
        lambda R, t: pose(R, times(R, t)),
    ),
    Mistake(
        "t-turned-back",
        "the translation comes out turned by R backwards: t is already in the "
        "outer frame",
        lambda R, t: pose(R, times(transposed(R), t)),
    ),
    *applied(of_a_pose(), pose),
]


def _reciprocal(T: Array) -> Array:
    with np.errstate(divide="ignore"):
        return 1.0 / T


def _undone(by: Callable[[Array, Array], Array]) -> Callable[[Array], Array]:
    """Return a function of T from one of its parts R and t."""
    return lambda T: by(*split(T))


INVERSE = [
    Mistake("unchanged", "T comes back as it went in: nothing is undone", lambda T: T),
    Mistake(
        "T-transposed",
        "the whole 4x4 is transposed. Only R is undone that way; the translation "
        "is now in the bottom row",
        transposed,
        "T transposed",
    ),
    Mistake(
        "t-only-negated",
        "R is right, but t is only negated: the way back has to be told in the "
        "turned frame's own axes",
        _undone(lambda R, t: pose(transposed(R), -t)),
        "the right one with t only negated",
    ),
    Mistake(
        "t-not-negated",
        "R is right and t is in the right axes, but it points there, not back",
        _undone(lambda R, t: pose(transposed(R), times(transposed(R), t))),
        "the right one with t reversed",
    ),
    Mistake(
        "t-kept",
        "R is right, but t is still the old one",
        _undone(lambda R, t: pose(transposed(R), t)),
        "the right one with t kept",
    ),
    Mistake(
        "t-turned-forwards",
        "R is right, but t is turned by R itself, not by what undoes R",
        _undone(lambda R, t: pose(transposed(R), -times(R, t))),
        "the right one with t turned by R",
    ),
    Mistake(
        "R-kept",
        "the translation is right, but R is still the old one: the turn is not undone",
        _undone(lambda R, t: pose(R, -times(transposed(R), t))),
        "the right one with R kept",
    ),
    Mistake(
        "R-kept-t-negated",
        "only t is negated: that undoes a plain move, but here the turn stays",
        _undone(lambda R, t: pose(R, -t)),
        "the right one with t only negated",
    ),
    Mistake(
        "R-kept-t-turned-forwards",
        "R is not undone, neither as the new rotation nor where it turns t",
        _undone(lambda R, t: pose(R, -times(R, t))),
    ),
    Mistake(
        "all-signs",
        "every entry is negated; that undoes an addition, not a transform",
        np.negative,
        "its negative",
    ),
    Mistake(
        "minus-R",
        "R and t are only negated: -R is a mirror image (det R = -1), and it undoes "
        "nothing",
        _undone(lambda R, t: pose(-R, -t)),
        "the right one made of -R and -t",
    ),
    Mistake(
        "one-over-each-entry",
        "each entry is inverted on its own; a matrix is undone as a whole",
        _reciprocal,
        "1 over each entry",
    ),
    *applied(of_a_pose(), rigid_inverse),
]
