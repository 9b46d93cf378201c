"""Mistakes in task 1.7 `predict_order(T_world_ee, T_extra)`.

`redo` takes both poses, (n, 4, 4) each, and returns the translations of
T_world_ee @ T_extra and of T_extra @ T_world_ee stacked, (n, 2, 3).
"""

from collections.abc import Callable

import numpy as np

from labkit.judge.matrices import split, times, transposed
from labkit.judge.mistake import Mistake
from robo47.checks import Array

# From (R_a, t_a, R_b, t_b), the parts of both factors, to the translation of a @ b.
Half = Callable[[Array, Array, Array, Array], Array]


def right(R_a: Array, t_a: Array, R_b: Array, t_b: Array) -> Array:
    """Return the translation of a @ b."""
    return times(R_a, t_b) + t_a


def both(half: Half, other: Half | None = None) -> Callable[[Array, Array], Array]:
    """Return the function of both poses that predicts each order with a half."""

    def redo(T_ee: Array, T_extra: Array) -> Array:
        ee, extra = split(T_ee), split(T_extra)
        first, second = half(*ee, *extra), (other or half)(*extra, *ee)
        return np.stack([first, second], axis=-2)

    return redo


# What goes wrong in one prediction: slug, words, the mistaken half.
_HALVES: list[tuple[str, str, Half]] = [
    (
        "only-summed",
        "the two translations are only added; the left factor also turns the right "
        "one's translation",
        lambda R_a, t_a, R_b, t_b: t_a + t_b,
    ),
    (
        "left-translation-lost",
        "the right factor's translation is turned, but the left factor's own is not "
        "added",
        lambda R_a, t_a, R_b, t_b: times(R_a, t_b),
    ),
    (
        "right-translation-lost",
        "only the left factor's translation is there; the right one's does not count",
        lambda R_a, t_a, R_b, t_b: t_a,
    ),
    (
        "turned-backwards",
        "the right factor's translation is turned the wrong way (by the transpose)",
        lambda R_a, t_a, R_b, t_b: times(transposed(R_a), t_b) + t_a,
    ),
    (
        "wrong-vector-turned",
        "the left factor's own translation is turned; it is the right factor's that is",
        lambda R_a, t_a, R_b, t_b: times(R_a, t_a) + t_b,
    ),
    (
        "wrong-rotation",
        "the right factor's translation is turned by its own R; it is the left "
        "factor's that turns it",
        lambda R_a, t_a, R_b, t_b: times(R_b, t_b) + t_a,
    ),
    (
        "both-turned",
        "both translations are turned; the left factor's own stays as it is",
        lambda R_a, t_a, R_b, t_b: times(R_a, t_a + t_b),
    ),
    (
        "subtracted",
        "one translation is subtracted where both add up",
        lambda R_a, t_a, R_b, t_b: times(R_a, t_b) - t_a,
    ),
    (
        "summed-by-columns",
        "the right factor's translation is multiplied entry by entry with R (R * t) "
        "and summed up; R @ t takes rows",
        lambda R_a, t_a, R_b, t_b: (R_a * t_b[..., None, :]).sum(axis=-2) + t_a,
    ),
    (
        "summed-by-entries",
        "R * t multiplies entry by entry; the rotation acts by R @ t",
        lambda R_a, t_a, R_b, t_b: (R_a * t_b[..., None]).sum(axis=-1) + t_a,
    ),
    (
        "diagonal-only",
        "only the diagonal of R acts on the translation; R @ t takes whole rows",
        lambda R_a, t_a, R_b, t_b: np.diagonal(R_a, axis1=-2, axis2=-1) * t_b + t_a,
    ),
    (
        "entries-of-4x4",
        "the two 4x4 are multiplied entry by entry (A * B); that is no product of "
        "matrices",
        lambda R_a, t_a, R_b, t_b: t_a * t_b,
    ),
    (
        "same-order-twice",
        "it repeats the other order's translation",
        lambda R_a, t_a, R_b, t_b: times(R_b, t_a) + t_b,
    ),
]


def _of_half(slug: str, says: str, half: Half) -> list[Mistake]:
    if slug == "same-order-twice":
        slug_both, says_both = (
            "orders-swapped",
            "the two are right, but in the wrong order: the first belongs to "
            "T_world_ee @ T_extra",
        )
    else:
        slug_both, says_both = slug, f"in both, {says}"
    return [
        Mistake(slug_both, says_both, both(half)),
        Mistake(slug, f"the first is wrong: {says}", both(half, right)),
        Mistake(slug, f"the second is wrong: {says}", both(right, half)),
    ]


PREDICT_ORDER = [m for row in _HALVES for m in _of_half(*row)] + [
    Mistake(
        "whole-numbers",
        "only whole numbers are left: an array of integers cuts off what is stored in "
        "it",
        lambda T_ee, T_extra: np.trunc(both(right)(T_ee, T_extra)),
        "the right ones cut to whole numbers",
    )
]
