"""Mistakes in task 2.1 `skew(w)`, which come back wherever a bracket is used."""

import numpy as np

from labkit.judge.mistake import Mistake
from robo47.checks import Array

from .moves import from_rows, skew, without


def outer(w: Array) -> Array:
    """Return w times w transposed, (..., 3, 3)."""
    return w[..., :, None] * w[..., None, :]


def _unit(w: Array) -> Array:
    return w / np.linalg.norm(w, axis=-1, keepdims=True)


SKEW = [
    Mistake(
        "p-cross-w",
        "this does p x w: every sign is the other way round (the matrix is transposed)",
        lambda w: -skew(w),
        "the right one with its signs reversed",
    ),
    Mistake(
        "no-minus",
        "there is no minus: [w] is its own negative transposed, not its own transpose",
        from_rows(lambda x, y, z: [[0, z, y], [z, 0, x], [y, x, 0]]),
        "the right one with every sign a plus",
    ),
    *(
        Mistake(
            "pair-of-signs",
            f"the two entries with {letter} have each other's sign",
            lambda w, flip=flip: skew(w * flip),
            f"the right one with {letter} negated",
        )
        for letter, flip in (("x", [-1, 1, 1]), ("y", [1, -1, 1]), ("z", [1, 1, -1]))
    ),
    *(
        Mistake(
            "letters-swapped",
            f"{a} and {b} have changed places",
            lambda w, order=order: skew(w[..., order]),
            "the right one with the two swapped",
        )
        for a, b, order in (
            ("x", "z", [2, 1, 0]),
            ("x", "y", [1, 0, 2]),
            ("y", "z", [0, 2, 1]),
        )
    ),
    *(
        Mistake(
            "letters-swapped",
            f"{a} and {b} have changed places, and all signs are reversed",
            lambda w, order=order: -skew(w[..., order]),
            "the right one with both",
        )
        for a, b, order in (
            ("x", "z", [2, 1, 0]),
            ("x", "y", [1, 0, 2]),
            ("y", "z", [0, 2, 1]),
        )
    ),
    Mistake(
        "half-empty",
        "only the upper right half is filled; the lower left one is its negative",
        lambda w: np.triu(skew(w)),
        "the right one without its lower half",
    ),
    Mistake(
        "half-empty",
        "only the lower left half is filled; the upper right one is its negative",
        lambda w: np.tril(skew(w)),
        "the right one without its upper half",
    ),
    Mistake(
        "outer-product",
        "this is w times w transposed, which does a projection, not a cross product",
        outer,
        "that product",
    ),
    Mistake(
        "on-the-diagonal",
        "w stands on the diagonal; w x p has no part of w along w",
        lambda w: outer(w) * np.eye(3) / np.where(w == 0, 1, w)[..., None],
        "the diagonal matrix",
    ),
    Mistake(
        "ones-on-diagonal",
        "the diagonal is 1; it has to be 0, since w x w is 0",
        lambda w: skew(w) + np.eye(3),
        "the right one plus the identity",
    ),
    Mistake(
        "made-unit",
        "w is divided by its length first; the cross product is as long as w says",
        lambda w: skew(_unit(w)),
        "the right one of w / |w|",
    ),
]


OF_A_UNIT_VECTOR = without(SKEW, "made-unit")  # which changes nothing
