"""9.6 `nis_interval(n, m)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Vector
from robo47.estimation import nis_interval

row = Row(Vector((2,), names=("the low one", "the high one")))


@row.inputs
def _(rng):
    n, m = rng.integers(5, 900, 6), [1, 2, 3, 6, 2, 1]
    pairs = [(int(a), b) for a, b in zip(n, m, strict=True)]
    return [(1950, 1), *pairs, (40, 3)]


def interval(m, c, z=1.96, power=3, root=np.sqrt):
    """Return the interval with other parts."""
    return m * (1 - c + np.array([-z, z]) * root(c)) ** power


@row.wrongs
def _(n, m):
    """m-forgotten: c has n alone; n NIS are a sum of n m squares => with c = 2 / (9 n)
    m-not-multiplied: m is missing in front: the mean NIS of a true filter is m => the
      right one / m
    sum-for-mean: this is for the sum of n NIS; their mean is asked for => times n
    not-cubed: the cube is missing: what is nearly normal is the cube root
    squared: it is squared; what is nearly normal is the cube root
    c-not-rooted: 1.96 is multiplied with c, a variance; sigma is its root
    shift-forgotten: 1 - c is 1: the mean of the cube root is a little less => with 1
      for 1 - c
    shift-sign: 1 + c for 1 - c
    nine-forgotten: c is 2 / (n m); it is 2 / (9 n m)
    two-forgotten: c is 1 / (9 n m); it is 2 / (9 n m)
    ninety: 1.645 leaves 5 in 100 on each side: that holds 90 times in 100; it takes
      1.96
    one-sigma: one sigma holds 68 times in 100; it takes 1.96
    normal: m +- 1.96 sqrt(2 m / n) takes the mean NIS itself for normal; it is skewed,
      and its cube root is nearly normal => m +- 1.96 sqrt(2 m / n)
    more-digits: 1.959964 is nearer to the truth than 1.96; asked for is 1.96, so that
      all have the same digits => with 1.959964
    high-first: the two are in the other order: low, then high
    """
    c = 2 / (9 * n * m)
    right = nis_interval(n, m)
    half = 1.96 * np.sqrt(2 * m / n)
    return {
        "m-forgotten": interval(m, 2 / (9 * n)),
        "m-not-multiplied": right / m,
        "sum-for-mean": right * n,
        "not-cubed": interval(m, c, power=1),
        "squared": interval(m, c, power=2),
        "c-not-rooted": interval(m, c, root=lambda c: c),
        "shift-forgotten": m * (1 + np.array([-1.96, 1.96]) * np.sqrt(c)) ** 3,
        "shift-sign": m * (1 + c + np.array([-1.96, 1.96]) * np.sqrt(c)) ** 3,
        "nine-forgotten": interval(m, 9 * c),
        "two-forgotten": interval(m, c / 2),
        "ninety": interval(m, c, 1.645),
        "one-sigma": interval(m, c, 1.0),
        "normal": np.array([m - half, m + half]),
        "more-digits": interval(m, c, 1.959964),
        "high-first": right[::-1].copy(),
    }


@row.right  # The sum of n m squares, divided by n.
def _(n, m):
    k = n * m
    low, high = (
        k * (1 - 2 / (9 * k) + z * (2 / (9 * k)) ** 0.5) ** 3 for z in (-1.96, 1.96)
    )
    return low / n, high / n


row.at_least_0(n="a count", m="a count", answer="a mean of squares")
