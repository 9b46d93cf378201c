"""2.1 `skew(w)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Matrix, Row
from robo47.screws import skew

row = Row(Matrix((3, 3)))

FLIPPED = {"x": [-1, 1, 1], "y": [1, -1, 1], "z": [1, 1, -1]}
SIGNS = (1, ""), (-1, " and reverses the sign of every entry")
SWAPPED = {"w_x and w_z": [2, 1, 0], "w_x and w_y": [1, 0, 2], "w_y and w_z": [0, 2, 1]}


@row.inputs
def _(rng):
    yield (np.array([0.0, 0.0, 1.0]),)
    yield from ((w,) for w in rng.numbers(-2, 2, 8, 3))


@row.wrongs
def _(w):
    """p-cross-w: your code reverses the sign of every entry, so your matrix times a
      vector p is p x w instead of w x p
    no-minus: none of your entries has a minus sign. Entries that mirror each other
      across the diagonal should have opposite signs
    outer-product: your code computes the outer product of w with itself. Each
      off-diagonal entry should be a component of w or its negative, and each diagonal
      entry should be 0
    on-the-diagonal: your code puts w on the diagonal. All diagonal entries should be 0
    """
    x, y, z = w
    return {
        "p-cross-w": skew(w).T,
        "no-minus": np.array([[0.0, z, y], [z, 0.0, x], [y, x, 0.0]]),
        "outer-product": np.outer(w, w),
        "on-the-diagonal": np.diag(w),
    }


for letter, signs in FLIPPED.items():
    row.wrong(
        "pair-of-signs",
        f"both of your entries that contain w_{letter} have the wrong sign",
    )(lambda w, signs=signs: skew(w * signs))
for sign, more in SIGNS:
    for letters, order in SWAPPED.items():
        row.wrong(
            "letters-swapped",
            f"your code swaps {letters}{more}",
            both=bool(more),
        )(lambda w, order=order, sign=sign: skew(sign * w[order]))
for half, filled, empty in (
    (np.triu, "upper", "lower"),
    (np.tril, "lower", "upper"),
):
    row.wrong(
        "half-empty",
        f"your code fills only the {filled} triangle. The {empty} triangle should "
        "contain the mirrored entries with the opposite sign",
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
