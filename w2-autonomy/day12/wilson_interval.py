"""12.6 `wilson_interval(successes, n)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Vector
from robo47.planning import wilson_interval

from .intervals import of_shares

row = Row(
    Vector((2,), names=("the lower endpoint", "the upper endpoint")),
    near=1e-7,  # 1.959964 for 1.96 is 4e-6 away
    at_edge=lambda successes, n: 0 <= successes <= n,
    unnamed=of_shares,
)


@row.inputs
def _(rng):
    for k, n in (
        (18, 60),
        (20, 20),
        (0, 60),
        (0, 0),
        (1, 1),
        (0, 1),
        (60, 60),
        (1, 40),
        (1, 3),
    ):
        yield k, n
    for _ in range(8):
        n = int(rng.integers(3, 400))
        yield int(rng.integers(0, n + 1)), n


def interval(k, n, z=1.96, centre=True, widen=True, divide=True):
    """Return the interval, made with other parts."""
    if n == 0:
        return np.array([0.0, 1.0])
    p = k / n
    middle = p + centre * z**2 / (2 * n)
    around = z * np.sqrt(p * (1 - p) / n + widen * z**2 / (4 * n**2))
    return (middle + np.array([-around, around])) / (1 + divide * z**2 / n)


row.cases(
    no_successes=lambda successes, n: successes == 0 < n,
    only_successes=lambda successes, n: successes == n > 0,
    successes_and_failures=lambda successes, n: 0 < successes < n,
)
row.cases(
    fewer_than_ten_trials=lambda successes, n: 0 < n < 10,
    ten_trials_and_more=lambda successes, n: n >= 10,
)


@row.rare
def _(rng):
    for n in (int(rng.integers(1, 10)), int(rng.integers(10, 400))):
        yield from ((k, n) for k in (0, n, int(rng.integers(0, n + 1))))


@row.wrongs
def _(successes, n):
    """wald: your code returns the Wald interval (`p +- z sqrt(p (1 - p) / n)`). Use the
      Wilson interval instead, because the width of a Wald interval is 0 for k = 0 and k
      = n
    wald-cut: your code returns the Wald interval, clamped to [0, 1]. Use the Wilson
      interval instead, because the width of a Wald interval is 0 for k = 0 and k = n
    centre-not-moved: your code omits the term z^2 / (2 n) from the centre. The correct
      centre is (k / n + z^2 / (2 n)) / (1 + z^2 / n)
    width-without-z2: your code omits the term z^2 / (4 n^2) under the square root. With
      this term, the width is positive even for k = 0
    not-divided: your code does not divide the centre and the half-width by 1 + z^2 / n.
      Divide both by this factor
    middle-not-divided: your code divides only the half-width by 1 + z^2 / n. Divide the
      centre by this factor too
    width-not-divided: your code divides only the centre by 1 + z^2 / n. Divide the
      half-width by this factor too
    root-n-forgotten: your code does not divide `p (1 - p)` by n. Divide this product by
      n, because more trials should make the interval narrower
    ninety: your code uses z = 1.645, which gives a 90 % interval. Use z = 1.96 for a 95
      % interval
    ninety-without-z2: your code uses z = 1.645 instead of 1.96, and it omits the term
      z^2 / (4 n^2) under the square root. Use z = 1.96, and add this term => both
    two-sigma: your code uses z = 2. Use z = 1.96 for a 95 % interval
    one-sigma: your code uses z = 1, which gives a 68 % interval. Use z = 1.96 for a 95
      % interval
    ninety-nine: your code uses z = 2.576, which gives a 99 % interval. Use z = 1.96 for
      a 95 % interval
    more-digits: your code uses z = 1.959964, which is more exact than 1.96. Use z =
      1.96, as the task specifies
    z-for-z2: your code uses z instead of z^2 in the centre and in the denominator. Use
      z^2 in both
    two-n: your code adds z^2 / n to k / n in the centre. Add z^2 / (2 n) instead
    four-forgotten: your code adds z^2 / n^2 under the square root. Add z^2 / (4 n^2)
      instead
    n-for-n2: your code adds z^2 / (4 n) under the square root. Add z^2 / (4 n^2)
      instead
    successes-for-p: your code uses k instead of the success rate k / n in the centre.
      Divide k by n
    failures: your code returns the interval for the n - k failures. Return the interval
      for the successes instead
    high-first: your code returns the upper endpoint first. Return the lower
      endpoint first
    high-first 2: for n > 0, your code returns the upper endpoint first. Return the
      lower endpoint first
    middle-and-width: your code returns the centre and the half-width. Return the two
      endpoints instead
    rule-of-three: for k = 0, your code returns 3 / n as the upper endpoint (the rule
      of three). Use the Wilson interval for k = 0 too
    rule-of-three 2: for k = 0 and k = n, your code uses the rule of three, with the
      endpoints `3 / n` and `1 - 3 / n`. Use the Wilson interval for these cases too
    rule-of-three 3: for k = 0 and k = n, your code uses the rule of three, with the
      endpoints `3 / n` and `1 - 3 / n`. Use the Wilson interval for these cases too
    plus-four: your code returns the Agresti-Coull interval: the Wald interval with p =
      (k + 2) / (n + 4) and n + 4 trials. Use the Wilson interval instead
    plus-four 2: your code returns the Agresti-Coull interval: the Wald interval with p
      = (k + z^2 / 2) / (n + z^2) and n + z^2 trials. Use the Wilson interval instead
    plus-four 3: your code returns the Agresti-Coull interval, clamped to [0, 1]: the
      Wald interval with p = (k + z^2 / 2) / (n + z^2) and n + z^2 trials. Use the
      Wilson interval instead
    one-more: your code uses p = (k + 1) / (n + 2), which adds one success and one
      failure. Use p = k / n instead
    quadratic-sign: your code uses `-2 k / n + z^2 / n` as the coefficient of p in the
      quadratic equation. Use `-(2 k / n + z^2 / n)` instead
    quadratic-z2: your code uses `-(2 k / n + z^2)` as the coefficient of p in the
      quadratic equation. Use `-(2 k / n + z^2 / n)` instead
    half-width: your code returns an interval that is half as wide as the Wilson
      interval. Add and subtract the whole half-width
    one-is-none: for n = 1, your code returns (0, 1). Use the formula, because only n =
      0 is a special case
    """
    k, trials = successes, n
    n = n or 1  # of no trial see below
    right = wilson_interval(k, n)
    z, p = 1.96, k / n
    middle, around = right.mean(), (right[1] - right[0]) / 2
    below = 1 + z**2 / n
    two = np.array([-1, 1])
    wald = p + two * z * np.sqrt(p * (1 - p) / n)
    q = (k + 2) / (n + 4)
    many = n + z**2
    coull = (k + z**2 / 2) / many
    more = (k + 1) / (n + 2)
    spread = p * (1 - p) / n
    agresti = coull + two * z * np.sqrt(coull * (1 - coull) / many)
    three = np.array([0, 3 / n]) if k == 0 else np.array([1 - 3 / n, 1])

    def with_root(under, centre=p + z**2 / (2 * n)):
        return (centre + two * z * np.sqrt(under)) / below

    def roots(minus_b):
        under = max(minus_b**2 - 4 * below * p * p, 0.0)
        return (minus_b + two * np.sqrt(under)) / (2 * below)

    table = {
        "wald": wald,
        "wald-cut": np.clip(wald, 0, 1),
        "centre-not-moved": interval(k, n, centre=False),
        "width-without-z2": interval(k, n, widen=False),
        "not-divided": interval(k, n, divide=False),
        "middle-not-divided": middle * below + two * around,
        "width-not-divided": middle + two * around * below,
        "root-n-forgotten": with_root(p * (1 - p) + z**2 / (4 * n**2)),
        "ninety": interval(k, n, 1.645),
        "ninety-without-z2": interval(k, n, 1.645, widen=False),
        "two-sigma": interval(k, n, 2.0),
        "one-sigma": interval(k, n, 1.0),
        "ninety-nine": interval(k, n, 2.576),
        "more-digits": interval(k, n, 1.959964),
        "z-for-z2": (p + z / (2 * n) + two * around * below) / (1 + z / n),
        "two-n": with_root(spread + z**2 / (4 * n**2), p + z**2 / n),
        "four-forgotten": with_root(spread + z**2 / n**2),
        "n-for-n2": with_root(spread + z**2 / (4 * n)),
        "successes-for-p": with_root(spread + z**2 / (4 * n**2), k + z**2 / (2 * n)),
        "failures": wilson_interval(n - k, n),
        "high-first": right[::-1],
        "high-first 2": right[::-1],
        "middle-and-width": np.array([middle, around]),
        "rule-of-three": np.array([0, 3 / n]) if k == 0 else right,
        "rule-of-three 2": three if k in (0, n) else right,
        "rule-of-three 3": np.clip(three, 0, 1) if k in (0, n) else right,
        "plus-four": q + two * z * np.sqrt(q * (1 - q) / (n + 4)),
        "plus-four 2": agresti,
        "plus-four 3": np.clip(agresti, 0, 1),
        "one-more": with_root(
            more * (1 - more) / n + z**2 / (4 * n**2), more + z**2 / (2 * n)
        ),
        "quadratic-sign": roots(2 * p - z**2 / n),
        "quadratic-z2": roots(2 * p + z**2),
        "half-width": middle + two * around / 2,
        "one-is-none": right if n > 1 else np.array([0.0, 1.0]),
    }
    if trials == 0:
        sure = np.array([0.0, 1.0])
        table = dict.fromkeys(table, sure) | {
            "high-first": sure[::-1],
            "middle-and-width": np.array([0.5, 0.5]),
            "half-width": np.array([0.25, 0.75]),
        }
    return table


@row.wrong
def none_divides(successes, n):
    """for n = 0, your code divides by 0. Return (0, 1), because no success rate
    can be excluded"""
    with np.errstate(all="ignore"):
        k, n = np.float64(successes), np.float64(n)
        p, z = k / n, 1.96
        around = z * np.sqrt(p * (1 - p) / n + z**2 / (4 * n**2))
        return (p + z**2 / (2 * n) + np.array([-around, around])) / (1 + z**2 / n)


@row.wrong("none-divides")
def _(successes, n):
    """for n = 0, your code returns (0, 0). Return (0, 1), because no success rate
    can be excluded"""
    return np.zeros(2) if n == 0 else wilson_interval(successes, n)


@row.wrong("another-z")
def _(successes, n):
    return interval(successes, n, 2.326)


@row.right  # The roots of the quadratic.
def _(successes, n):
    if n == 0:
        return 0.0, 1.0
    z2, p = 1.96**2, successes / n
    return np.sort(np.roots([n + z2, -(2 * n * p + z2), n * p**2]).real)


row.at_least_0(successes="a count", n="a count", answer="proportions")
