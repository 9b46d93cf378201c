"""9.6 `nis_interval(n, m)`: its questions and its mistakes."""

from functools import partial

import numpy as np

from labkit.judge import Row, Vector
from robo47.estimation import nis_interval

row = Row(Vector((2,), names=("the low one", "the high one")))


@row.inputs
def _(rng):
    n, m = rng.integers(5, 900, 6), [1, 2, 3, 6, 2, 1]
    pairs = [(int(a), b) for a, b in zip(n, m, strict=True)]
    return [(1950, 1), *pairs, (40, 3)]


def interval(
    n, m, *, c=lambda n, m: 2 / (9 * n * m), sigma=np.sqrt, z=1.96, power=3,
    middle=lambda c: 1 - c, front=lambda n, m: m,
):  # fmt: skip
    """Return the interval with other parts."""
    own = c(n, m)
    return front(n, m) * (middle(own) + np.array([-z, z]) * sigma(own)) ** power


for slug, says, redone, other in (
    ("m-forgotten", "c has n alone; n NIS are a sum of n m squares",
     "with c = 2 / (9 n)", {"c": lambda n, m: 2 / (9 * n)}),
    ("n-forgotten", "c has m alone; n NIS are a sum of n m squares",
     "with c = 2 / (9 m)", {"c": lambda n, m: 2 / (9 * m)}),
    ("nine-forgotten", "c is 2 / (n m); it is 2 / (9 n m)", "with c = 2 / (n m)",
     {"c": lambda n, m: 2 / (n * m)}),
    ("two-forgotten", "c is 1 / (9 n m); it is 2 / (9 n m)", "with c = 1 / (9 n m)",
     {"c": lambda n, m: 1 / (9 * n * m)}),
    ("multiplied-for-divided", "c is 2 / 9 times n m: 2 / 9 * n * m divides by 9 "
     "alone; write 2 / (9 * n * m)", "with 2 / 9 * n * m",
     {"c": lambda n, m: 2 / 9 * n * m}),
    ("m-above", "c is 2 / 9 / n times m: 2 / 9 / n * m divides by n alone; write 2 / "
     "(9 * n * m)", "with 2 / 9 / n * m", {"c": lambda n, m: 2 / 9 / n * m}),
    ("added-for-multiplied", "c has n + m; n NIS are a sum of n m squares",
     "with c = 2 / (9 (n + m))", {"c": lambda n, m: 2 / (9 * (n + m))}),
    ("whole-division", "c is 0: // cuts off the fraction of 2 / (9 n m)", "with c = 0",
     {"c": lambda n, m: 2 // (9 * n * m)}),
    ("c-not-rooted", "1.96 is multiplied with c, a variance; sigma is its root",
     "with 1.96 c", {"sigma": lambda c: c}),
    ("not-cubed", "the cube is missing: what is nearly normal is the cube root",
     "without the cube", {"power": 1}),
    ("squared", "it is squared; what is nearly normal is the cube root", "squared",
     {"power": 2}),
    ("shift-forgotten", "1 - c is 1: the mean of the cube root is a little less",
     "with 1 for 1 - c", {"middle": lambda c: 1.0}),
    ("shift-sign", "1 + c stands for 1 - c", "with 1 + c", {"middle": lambda c: 1 + c}),
    ("ninety", "1.645 leaves 5 in 100 on each side: that holds 90 times in 100; it "
     "takes 1.96", "with 1.645", {"z": 1.645}),
    ("two-sigma", "2 is taken for 1.96; asked for is 1.96, so that all have the same "
     "digits", "with 2", {"z": 2.0}),
    ("ninety-nine", "2.576 holds 99 times in 100; it takes 1.96", "with 2.576",
     {"z": 2.576}),
    ("three-sigma", "three sigma hold 997 times in 1000; it takes 1.96", "with 3",
     {"z": 3.0}),
    ("one-sigma", "one sigma holds 68 times in 100; it takes 1.96", "with 1",
     {"z": 1.0}),
    ("more-digits", "1.959964 is nearer to the truth than 1.96; asked for is 1.96, so "
     "that all have the same digits", "with 1.959964", {"z": 1.959964}),
    ("m-not-multiplied", "m is missing in front: the mean NIS of a true filter is m",
     "the right one / m", {"front": lambda n, m: 1.0}),
    ("m-cubed", "m is cubed as well; it stands before the cube", "with m^3 in front",
     {"front": lambda n, m: m**3}),
    ("sum-for-mean", "this is for the sum of n NIS; their mean is asked for", "times n",
     {"front": lambda n, m: n * m}),
    ("n-for-m", "n stands in front; it is m", "with n in front",
     {"front": lambda n, m: n}),
):  # fmt: skip
    row.wrong(slug, says, redone)(partial(interval, **other))


@row.wrongs
def _(n, m):
    """normal: m +- 1.96 sqrt(2 m / n) takes the mean NIS itself for normal; it is
      skewed, and its cube root is nearly normal => m +- 1.96 sqrt(2 m / n)
    one-over-n: m +- 1.96 / sqrt(n) is the interval of a mean of normal numbers; the
      spread of a NIS is no 1 => m +- 1.96 / sqrt(n)
    high-first: the two are in the other order: low, then high
    cube-inside: each part is cubed alone; it is the cube of the sum => m ((1 - c)^3 -+
      (1.96 sigma)^3)
    """
    c = 2 / (9 * n * m)
    half = 1.96 * np.sqrt(2 * m / n)
    cubes = np.array([-1, 1]) * (1.96 * np.sqrt(c)) ** 3
    return {
        "normal": np.array([m - half, m + half]),
        "one-over-n": m + np.array([-1.96, 1.96]) / np.sqrt(n),
        "high-first": nis_interval(n, m)[::-1].copy(),
        "cube-inside": m * ((1 - c) ** 3 + cubes),
    }


@row.right  # The sum of n m squares, divided by n.
def _(n, m):
    k = n * m
    low, high = (
        k * (1 - 2 / (9 * k) + z * (2 / (9 * k)) ** 0.5) ** 3 for z in (-1.96, 1.96)
    )
    return low / n, high / n


row.at_least_0(n="a count", m="a count", answer="a mean of squares")
