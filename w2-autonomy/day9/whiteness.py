"""9.7 `whiteness(y)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Scalar
from robo47.estimation import whiteness

# An edge value may be the same everywhere: then nothing varies.
row = Row(Scalar(), at_edge=lambda y: np.ptp(y) > 0.0)


@row.inputs
def _(rng):
    drawn = [rng.numbers(-1, 2, n) for n in (5, 8, 20, 30)]
    slow = [np.cumsum(rng.numbers(-1, 1, n)) for n in (6, 25)]
    return [(np.array([1.0, -1.0, 1.0, -1.0]),), *((y,) for y in [*drawn, *slow])]


@row.wrongs
def _(y):
    """mean-not-taken-off: the mean is not taken off: an offset alone makes neighbours
      look alike => with y as it is
    not-normalised: it is not divided by the sum of squares: it has y's unit squared
    by-sigma: it is divided by the root of the sum of squares; its square drops the unit
    mean-of-products: n - 1 products and n squares are each averaged; the sums are
      divided => times n / (n - 1)
    two-means: each of the two rows has a mean and a size of its own, as np.corrcoef
      does => np.corrcoef(y[1:], y[:-1])[0, 1]
    squares-of-the-first: it is divided by the squares of the first n - 1 alone
    lag-two: each is compared with the last but one
    lag-zero: each is compared with itself: that is 1
    round-the-corner: the last is compared with the first, as by np.roll
    size-only: its sign is lost: surprises that alternate are below 0
    squared: it is squared
    sign: its sign is the other one
    one-minus: it is 1 minus that: white noise is 0
    of-the-changes: it is that of the changes of y, not of y
    """
    d = y - y.mean()
    right = whiteness(y)
    products = d[1:] @ d[:-1]
    table = {
        "mean-not-taken-off": y[1:] @ y[:-1] / (y @ y),
        "not-normalised": products,
        "by-sigma": products / np.sqrt(d @ d),
        "mean-of-products": right * len(y) / (len(y) - 1),
        "two-means": lambda: np.corrcoef(y[1:], y[:-1])[0, 1],
        "squares-of-the-first": products / (d[:-1] @ d[:-1]),
        "lag-two": d[2:] @ d[:-2] / (d @ d),
        "lag-zero": 1.0,
        "round-the-corner": d @ np.roll(d, 1) / (d @ d),
        "size-only": abs(right),
        "squared": right**2,
        "sign": -right,
        "one-minus": 1 - right,
        "of-the-changes": lambda: whiteness(np.diff(y)),
    }
    return table


@row.right  # By np.correlate.
def _(y):
    d = y - np.mean(y)
    both = np.correlate(d, d, "full")
    return both[len(d)] / both[len(d) - 1]
