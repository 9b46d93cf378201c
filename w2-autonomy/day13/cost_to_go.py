"""13.3 `cost_to_go(P, x)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Scalar

from .asked import definite

row = Row(Scalar())


@row.inputs
def _(rng):
    P = np.array([[2.0, 1], [1, 2.5]])
    drawn = [(definite(rng, n), rng.numbers(-2, 2, n)) for n in (2, 3, 5, 2, 4, 3)]
    return [(P, np.array([1.0, 2.0])), *drawn]


@row.wrongs
def _(P, x):
    """half: half of it: the costs of this day's LQR have no 1/2 => half of it
    root: its root is a length, and no cost
    P-forgotten: x . x: P is missing
    diagonal-of-P: of P only the diagonal is used => with P's diagonal
    P-squared: P is multiplied twice: |P x|^2
    length-of-P-x: that is the length of P x; x stands on both sides of P
    doubled: it is twice as large
    P-inverted: P is inverted
    summed: the entries of P x are added; they are multiplied by those of x
    P-rooted: P is rooted first => with the root of each entry's size
    P-by-squares: P is multiplied by the squares of x and summed; P's other entries
      belong to products
    trace: P is taken for its trace
    one-half-of-P: of P only the upper half is used, or only the lower one
    """
    right = x @ P @ x
    return {
        "half": right / 2,
        "root": np.sqrt(right),
        "P-forgotten": x @ x,
        "diagonal-of-P": np.diag(P) @ x**2,
        "P-squared": (P @ x) @ (P @ x),
        "length-of-P-x": np.linalg.norm(P @ x),
        "doubled": 2 * right,
        "P-inverted": x @ np.linalg.solve(P, x),
        "summed": np.sum(P @ x),
        "P-rooted": x @ np.sqrt(np.abs(P)) @ x,
        "P-by-squares": np.sum(P @ x**2),
        "trace": np.trace(P) * (x @ x),
        "one-half-of-P": x @ np.triu(P) @ x,
    }


row.at_least_0(answer="a sum of squares")


@row.right  # Entry by entry.
def _(P, x):
    return sum(P[i, j] * a * b for i, a in enumerate(x) for j, b in enumerate(x))


row.spans(  # as small, or as large, as in the lab
    P=(lambda P: 30 * P,),
    x=(lambda x: 0.0006 * x,),
)
