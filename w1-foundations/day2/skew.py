"""2.1 `skew(w)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Matrix, Row
from robo47.screws import skew

row = Row(Matrix((3, 3)))

FLIPPED = {"x": [-1, 1, 1], "y": [1, -1, 1], "z": [1, 1, -1]}
SIGNS = (1, "", "the two swapped"), (-1, ", and all signs are reversed", "both")
SWAPPED = {"x and z": [2, 1, 0], "x and y": [1, 0, 2], "y and z": [0, 2, 1]}


@row.inputs
def _(rng):
    yield (np.array([0.0, 0.0, 1.0]),)
    yield from ((w,) for w in rng.numbers(-2, 2, 8, 3))


@row.wrongs
def _(w):
    """p-cross-w: this does p x w: every sign is the other way round (the matrix is
      transposed) => the right one with its signs reversed
    no-minus: there is no minus: [w] is its own negative transposed, not its own
      transpose => the right one with every sign a plus
    outer-product: this is w times w transposed, which does a projection, not a cross
      product => that product
    on-the-diagonal: w stands on the diagonal; w x p has no part of w along w
    ones-on-diagonal: the diagonal is 1; it has to be 0, since w x w is 0
    made-unit: w is divided by its length first; the cross product is as long as w says
      => the right one of w / |w|
    """
    x, y, z = w
    return {
        "p-cross-w": skew(w).T,
        "no-minus": np.array([[0.0, z, y], [z, 0.0, x], [y, x, 0.0]]),
        "outer-product": np.outer(w, w),
        "on-the-diagonal": np.diag(w),
        "ones-on-diagonal": skew(w) + np.eye(3),
        "made-unit": lambda: skew(w / np.linalg.norm(w)),
    }


for letter, signs in FLIPPED.items():
    row.wrong(
        "pair-of-signs",
        f"the two entries with {letter} have each other's sign",
        f"the right one with {letter} negated",
    )(lambda w, signs=signs: skew(w * signs))
for sign, more, redone in SIGNS:
    for letters, order in SWAPPED.items():
        row.wrong(
            "letters-swapped",
            f"{letters} have changed places{more}",
            f"the right one with {redone}",
        )(lambda w, order=order, sign=sign: skew(sign * w[order]))
for half, filled, empty in (
    (np.triu, "upper right", "lower left"),
    (np.tril, "lower left", "upper right"),
):
    row.wrong(
        "half-empty",
        f"only the {filled} half is filled; the {empty} one is its negative",
        f"the right one without its {empty.split()[0]} half",
    )(lambda w, half=half: half(skew(w)))


@row.wrong("whole-numbers")  # An array of integers to start from.
def _(w):
    return skew(w).astype(int)


@row.wrong("shape")  # A cross product instead of a matrix.
def _(w):
    return np.cross(w, [1.0, 0.0, 0.0])


row.spans(  # as small, or as large, as in the lab
    w=(lambda w: 0.05 * w,),
)
