"""9.7 `lag1_autocorrelation(y)`: its questions and its mistakes."""

from functools import partial

import numpy as np

from labkit.judge import Row, Scalar
from robo47.estimation import lag1_autocorrelation

# An edge value may be the same everywhere: then nothing varies.
row = Row(Scalar(), at_edge=lambda y: np.ptp(y) > 0.0)


@row.inputs
def _(rng):
    drawn = [rng.numbers(-1, 2, n) for n in (5, 8, 20, 30)]
    slow = [np.cumsum(rng.numbers(-1, 1, n)) for n in (6, 25)]
    return [(np.array([1.0, -1.0, 1.0, -1.0]),), *((y,) for y in [*drawn, *slow])]


row.spans(y=(lambda y: 1e-4 * y, lambda y: 1e4 * y))


def centred(y):
    """Return y without its mean."""
    return y - y.mean()


def correlation(
    y, *, above=centred, below=centred, pairs=lambda d: d[1:] @ d[:-1],
    squares=lambda d: d @ d, share=lambda n: 1.0, told=lambda r: r,
):  # fmt: skip
    """Return the correlation with other parts."""
    return told(share(len(y)) * pairs(above(y)) / squares(below(y)))


AS_IT_IS = {"above": lambda y: y}
for slug, says, redone, other in (
    ("mean-not-taken-off", "the mean is not taken off: an offset alone makes "
     "neighbours look alike", "with y as it is", {**AS_IT_IS, "below": lambda y: y}),
    ("mean-left-in-the-products", "the mean is taken off in the squares, but not in "
     "the products", "with y as it is above", AS_IT_IS),
    ("mean-left-in-the-squares", "the mean is taken off in the products, but not in "
     "the squares", "with y as it is below", {"below": lambda y: y}),
    ("not-normalised", "it is not divided by the sum of squares: it has y's unit "
     "squared", "the sum of products", {"squares": lambda d: 1.0}),
    ("by-sigma", "it is divided by the root of the sum of squares; its square drops "
     "the unit", "with the root below", {"squares": lambda d: np.sqrt(d @ d)}),
    ("squares-of-the-first", "it is divided by the squares of the first n - 1 alone",
     "without the last below", {"squares": lambda d: d[:-1] @ d[:-1]}),
    ("squares-of-the-last", "it is divided by the squares of the last n - 1 alone",
     "without the first below", {"squares": lambda d: d[1:] @ d[1:]}),
    ("two-sizes", "each of the two rows has a size of its own; the sum of all squares "
     "is below", "with the root of both rows' squares",
     {"squares": lambda d: np.sqrt((d[1:] @ d[1:]) * (d[:-1] @ d[:-1]))}),
    ("by-n-sigma", "it is divided by sigma, and by n - 1 for n; its square drops the "
     "unit", "the mean of products over sigma", {"squares": lambda d: np.sqrt(
         d @ d / len(d)), "share": lambda n: 1 / (n - 1)}),
    ("median-for-mean", "the median is taken off; it is the mean", "with the median",
     {"above": lambda y: y - np.median(y), "below": lambda y: y - np.median(y)}),
    ("mean-of-products", "n - 1 products and n squares are each averaged; the sums are "
     "divided", "times n / (n - 1)", {"share": lambda n: n / (n - 1)}),
    ("variance-for-sum", "the sum of products is divided by a mean of squares; sums "
     "are divided", "times n", {"share": lambda n: n}),
    ("mean-by-sum", "a mean of products stands above; it is their sum",
     "divided by n - 1", {"share": lambda n: 1 / (n - 1)}),
    ("divided-by-n", "it is divided by n as well", "divided by n",
     {"share": lambda n: 1 / n}),
    ("lag-two", "each is compared with the last but one", "with y_k y_(k+2)",
     {"pairs": lambda d: d[2:] @ d[:-2]}),
    ("lag-zero", "each is compared with itself: that is 1", "1",
     {"pairs": lambda d: d @ d}),
    ("round-the-corner", "the last is compared with the first, as by np.roll",
     "with np.roll", {"pairs": lambda d: d @ np.roll(d, 1)}),
    ("size-only", "its sign is lost: surprises that alternate are below 0", "its size",
     {"told": abs}),
    ("squared", "it is squared", "its square", {"told": np.square}),
    ("sign", "its sign is the other one", "its negative", {"told": np.negative}),
    ("one-minus", "it is 1 minus that: white noise is 0", "1 minus it",
     {"told": lambda r: 1 - r}),
):  # fmt: skip
    row.wrong(slug, says, redone)(partial(correlation, **other))


@row.wrongs
def _(y):
    """two-means: each of the two rows has a mean and a size of its own, as np.corrcoef
      does => np.corrcoef(y[1:], y[:-1])[0, 1]
    of-the-changes: it is that of the changes of y, not of y
    changes-squared: it is the sum of squared changes over the sum of squares: 2 for
      white noise => Durbin and Watson's number
    """
    d = centred(y)
    return {
        "two-means": lambda: np.corrcoef(y[1:], y[:-1])[0, 1],
        "of-the-changes": lambda: lag1_autocorrelation(np.diff(y)),
        "changes-squared": np.sum(np.diff(y) ** 2) / (d @ d),
    }


@row.right  # By np.correlate.
def _(y):
    d = y - np.mean(y)
    both = np.correlate(d, d, "full")
    return both[len(d)] / both[len(d) - 1]


@row.wrong(
    "not-at-every-size", hidden="the numbers of the lab stay within its limits"
)  # A guard for 0 / 0.
def _(y):
    return correlation(y, squares=lambda d: d @ d + 1e-9)
