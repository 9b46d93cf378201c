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
    squares=lambda d: d @ d, share=lambda n: 1.0,
):  # fmt: skip
    """Return the autocorrelation with another part."""
    return share(len(y)) * pairs(above(y)) / squares(below(y))


AS_IT_IS = {"above": lambda y: y}
for slug, says, other in (
    ("mean-not-taken-off",
     "your code does not subtract the mean of y. Subtract the mean first, because a "
     "constant offset makes neighbouring entries seem correlated",
     {**AS_IT_IS, "below": lambda y: y}),
    ("mean-left-in-the-products",
     "your code subtracts the mean of y only in the squares, not in the products. "
     "Subtract the mean in both", AS_IT_IS),
    ("mean-left-in-the-squares",
     "your code subtracts the mean of y only in the products, not in the squares. "
     "Subtract the mean in both",
     {"below": lambda y: y}),
    ("squares-of-the-first",
     "your code omits the square of the last entry from the denominator. Include all n "
     "squares",
     {"squares": lambda d: d[:-1] @ d[:-1]}),
    ("squares-of-the-last",
     "your code omits the square of the first entry from the denominator. Include all "
     "n squares",
     {"squares": lambda d: d[1:] @ d[1:]}),
    ("two-sizes",
     "your code divides by the product of the norms of d[1:] and d[:-1], where d is y "
     "minus its mean. Divide by the sum of all n squares instead",
     {"squares": lambda d: np.sqrt((d[1:] @ d[1:]) * (d[:-1] @ d[:-1]))}),
    ("by-n-sigma",
     "your code divides the mean of the products by the standard deviation. Divide the "
     "sum of the products by the sum of the squares instead, so that the unit cancels",
     {"squares": lambda d: np.sqrt(d @ d / len(d)), "share": lambda n: 1 / (n - 1)}),
    ("mean-of-products",
     "your code divides the mean of n - 1 products by the mean of n squares. Divide "
     "the sum of the products by the sum of the squares instead",
     {"share": lambda n: n / (n - 1)}),
    ("variance-for-sum",
     "your code divides the sum of the products by the mean of the squares. Divide the "
     "sum of the products by the sum of the squares instead",
     {"share": lambda n: n}),
    ("mean-by-sum", "your code divides the mean of the products by the sum of the "
                    "squares. Divide the sum of the products by the sum of the "
                    "squares instead",
     {"share": lambda n: 1 / (n - 1)}),
    ("mean-by-sum", "your code divides the mean of the products by the sum of the "
                    "squares. Divide the sum of the products by the sum of the "
                    "squares instead",
     {"share": lambda n: 1 / n}),
    ("lag-two",
     "your code multiplies each entry by the entry two positions later. Multiply each "
     "entry by the next entry instead, because the lag is 1",
     {"pairs": lambda d: d[2:] @ d[:-2]}),
    ("lag-zero", "your code multiplies each entry by itself, so the result is always "
                 "1. Multiply each entry by the next entry instead",
     {"pairs": lambda d: d @ d}),
    ("round-the-corner", "your code multiplies the last entry by the first, as with "
                         "np.roll. Omit this product, because the last and the first "
                         "entry are not neighbours",
     {"pairs": lambda d: d @ np.roll(d, 1)}),
):  # fmt: skip
    row.wrong(slug, says)(partial(correlation, **other))


@row.wrongs
def _(y):
    """two-means: your code uses a separate mean and norm for y[1:] and y[:-1], as
      np.corrcoef does. Use the mean of the whole y for both slices, and divide by the
      sum of all n squares
    of-the-changes: your code returns the autocorrelation of the differences between
      neighbouring entries. Return the autocorrelation of y itself instead
    changes-squared: your code returns the Durbin-Watson statistic, which uses the
      squared differences of neighbouring entries. Use the products of neighbouring
      entries instead
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
