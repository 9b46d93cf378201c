"""9.6 `nis_interval(n, m)`: its questions and its mistakes."""

from functools import partial

import numpy as np

from labkit.judge import Row, Vector

row = Row(Vector((2,), names=("the lower endpoint", "the upper endpoint")))


@row.inputs
def _(rng):
    n, m = rng.integers(5, 900, 6), [1, 2, 3, 6, 2, 1]
    pairs = [(int(a), b) for a, b in zip(n, m, strict=True)]
    return [(1950, 1), *pairs, (40, 3)]


def interval(
    n, m, *, c=lambda n, m: 2 / (9 * n * m), z=1.96, middle=lambda c: 1 - c,
    front=lambda n, m: m,
):  # fmt: skip
    """Return the interval with another variance, factor, mean or front."""
    own = c(n, m)
    return front(n, m) * (middle(own) + np.array([-z, z]) * np.sqrt(own)) ** 3


for slug, says, other in (
    ("multiplied-for-divided",
     "your variance of the cube root is 2 n m / 9, as from 2 / 9 * n * m. It should be "
     "2 / (9 n m)",
     {"c": lambda n, m: 2 / 9 * n * m}),
    ("added-for-multiplied",
     "your code uses n + m in the variance of the cube root. Use n m instead, because "
     "the sum of n NIS values has n m degrees of freedom",
     {"c": lambda n, m: 2 / (9 * (n + m))}),
    ("whole-division",
     "your variance of the cube root is 0, as from the operator //. It should be 2 / "
     "(9 n m)",
     {"c": lambda n, m: 2 // (9 * n * m)}),
    ("shift-forgotten",
     "your function uses 1 as the mean of the cube root. Use 1 - c instead, where c is "
     "the variance of the cube root", {"middle": lambda c: 1.0}),
    ("shift-sign",
     "your function uses 1 + c as the mean of the cube root. Use 1 - c instead, where "
     "c is the variance of the cube root", {"middle": lambda c: 1 + c}),
    ("ninety",
     "your function uses 1.645 standard deviations, which enclose 90 % of a Gaussian. "
     "Use 1.96 standard deviations for 95 %", {"z": 1.645}),
    ("two-sigma",
     "your function uses 2 standard deviations, which enclose 95.4 % of a Gaussian. "
     "Use 1.96 standard deviations for 95 %", {"z": 2.0}),
    ("ninety-nine",
     "your function uses 2.576 standard deviations, which enclose 99 % of a Gaussian. "
     "Use 1.96 standard deviations for 95 %", {"z": 2.576}),
    ("more-digits", "your function uses 1.959964 standard deviations. Use 1.96, as "
                    "specified in the task",
     {"z": 1.959964}),
    ("m-cubed",
     "your result has the factor m^3. Multiply only the cube itself by m, so that m is "
     "not cubed",
     {"front": lambda n, m: m**3}),
):  # fmt: skip
    row.wrong(slug, says)(partial(interval, **other))


@row.wrongs
def _(n, m):
    """normal: your code uses m +- 1.96 sqrt(2 m / n), which treats the mean NIS as
      Gaussian. Compute the interval for the cube root instead, because the cube root is
      closer to Gaussian
    one-over-n: your code uses m +- 1.96 / sqrt(n), which assumes a standard deviation
      of 1 for each NIS. Compute the interval for the cube root instead, because the
      cube root is closer to Gaussian
    cube-inside: your code cubes 1 - c and 1.96 sqrt(c) separately. Cube the sum and the
      difference of the two instead
    """
    c = 2 / (9 * n * m)
    half = 1.96 * np.sqrt(2 * m / n)
    cubes = np.array([-1, 1]) * (1.96 * np.sqrt(c)) ** 3
    return {
        "normal": np.array([m - half, m + half]),
        "one-over-n": m + np.array([-1.96, 1.96]) / np.sqrt(n),
        "cube-inside": m * ((1 - c) ** 3 + cubes),
    }


@row.right  # For the sum of n m squares, then divided by n.
def _(n, m):
    k = n * m
    low, high = (
        k * (1 - 2 / (9 * k) + z * (2 / (9 * k)) ** 0.5) ** 3 for z in (-1.96, 1.96)
    )
    return low / n, high / n


row.at_least_0(n="a count", m="a count", answer="a mean of squares")
