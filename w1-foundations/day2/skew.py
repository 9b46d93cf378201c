"""2.1 `skew(w)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Matrix, draw
from labkit.judge.argument_mistakes import Change
from labkit.judge.row import Row
from robo47.screws import skew

row = Row(Matrix((3, 3)))

FLIPPED = {"x": [-1, 1, 1], "y": [1, -1, 1], "z": [1, 1, -1]}
SWAPPED = {"x and z": [2, 1, 0], "x and y": [1, 0, 2], "y and z": [0, 2, 1]}


@row.inputs
def _(rng):
    yield (np.array([0.0, 0.0, 1.0]),)
    yield from ((w,) for w in draw.numbers(rng, -2, 2, 8, 3))


@row.wrong
def p_cross_w(w):
    """this does p x w: every sign is the other way round (the matrix is transposed) =>
    the right one with its signs reversed"""
    x, y, z = w
    return np.array([[0.0, z, -y], [-z, 0.0, x], [y, -x, 0.0]])


@row.wrong
def no_minus(w):
    """there is no minus: [w] is its own negative transposed, not its own transpose =>
    the right one with every sign a plus"""
    x, y, z = w
    return np.array([[0.0, z, y], [z, 0.0, x], [y, x, 0.0]])


row.of_argument(
    "w",
    *(
        Change(
            "pair-of-signs",
            f"the two entries with {letter} have each other's sign",
            lambda w, signs=signs: w * signs,
            f"the right one with {letter} negated",
        )
        for letter, signs in FLIPPED.items()
    ),
    *(
        Change(
            "letters-swapped",
            f"{letters} have changed places",
            lambda w, order=order: w[order],
            "the right one with the two swapped",
        )
        for letters, order in SWAPPED.items()
    ),
    *(
        Change(
            "letters-swapped",
            f"{letters} have changed places, and all signs are reversed",
            lambda w, order=order: -w[order],
            "the right one with both",
        )
        for letters, order in SWAPPED.items()
    ),
)


for half, filled, empty in (
    (np.triu, "upper right", "lower left"),
    (np.tril, "lower left", "upper right"),
):
    row.wrong(
        "half-empty",
        f"only the {filled} half is filled; the {empty} one is its negative",
        f"the right one without its {empty.split()[0]} half",
    )(lambda w, half=half: half(skew(w)))


@row.wrong
def outer_product(w):
    """this is w times w transposed, which does a projection, not a cross product =>
    that product"""
    return np.outer(w, w)


@row.wrong
def on_the_diagonal(w):
    """w stands on the diagonal; w x p has no part of w along w => the diagonal
    matrix"""
    return np.diag(w)


@row.wrong
def ones_on_diagonal(w):
    """the diagonal is 1; it has to be 0, since w x w is 0 => the right one plus the
    identity"""
    return skew(w) + np.eye(3)


@row.wrong
def made_unit(w):
    """w is divided by its length first; the cross product is as long as w says => the
    right one of w / |w|"""
    return skew(w / np.linalg.norm(w))


@row.wrong("whole-numbers")  # An array of integers to start from.
def _(w):
    return skew(w).astype(int)


@row.wrong("shape")  # A cross product instead of a matrix.
def _(w):
    return np.cross(w, [1.0, 0.0, 0.0])
