"""14.8 `success_rate(success)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Vector

row = Row(Vector((3,), names=("the rate", "the lower endpoint", "the upper endpoint")))


@row.inputs
def _(rng):
    yield (np.ones(8, bool),)
    yield (np.arange(100) >= 3,)
    yield (np.zeros(60, bool),)
    for n, share in ((1, 0.9), (5, 0.4), (20, 0.5), (60, 0.2), (60, 0.8), (200, 0.6)):
        yield (rng.uniform(size=n) < share,)


def wilson(k, n, z=1.96, moved=True, inside=True, divided=True):
    """Return Wilson's interval, where one of its parts may be missing."""
    middle = k + z**2 / 2 if moved else k
    around = z * np.sqrt(k * (n - k) / n + (z**2 / 4 if inside else 0))
    return np.array([middle - around, middle + around]) / (n + z**2 if divided else n)


@row.wrongs
def _(success):
    """plain: your code returns the Wald interval. Use Day 12's `wilson_interval`
      instead, because the width of a Wald interval is 0 for 8 successes in 8 trials
    plain-to-0-and-1: your code returns the Wald interval, clamped to [0, 1]. Use Day
      12's `wilson_interval` instead
    middle-for-rate: your code returns the centre of the interval as the rate. Return
      the fraction of successes instead
    order: your code returns the interval first. Use the order (rate, low, high)
    ends-swapped: your code swaps the two endpoints of the interval. Use the order
      (rate, low, high)
    half-width: your last two results are the distances from the rate to the endpoints
      of the interval. Return the endpoints themselves instead
    failures: your code computes the interval from the number of failures. Use the
      number of successes instead
    one-sided: your code uses z = 1.645, which gives a 90 % interval. Use z = 1.96 for a
      95 % interval
    ninety-nine: your code uses z = 2.576, which gives a 99 % interval. Use z = 1.96 for
      a 95 % interval
    n-less-one: your code multiplies the rate and both endpoints of the interval by n /
      (n - 1). Omit this factor
    per-cent: your code returns percentages. Return fractions instead
    """
    won = np.asarray(success, float)
    n = len(won)
    k = won.sum()
    p = k / n
    low, high = wilson(k, n)
    plain = 1.96 * np.sqrt(p * (1 - p) / n)
    right = np.array([p, low, high])
    return {
        "plain": np.array([p, p - plain, p + plain]),
        "plain-to-0-and-1": np.array([p, max(p - plain, 0), min(p + plain, 1)]),
        "middle-for-rate": np.array([(low + high) / 2, low, high]),
        "order": np.array([low, high, p]),
        "ends-swapped": np.array([p, high, low]),
        "half-width": np.array([p, p - low, high - p]),
        "failures": np.array([p, *wilson(n - k, n)]),
        "one-sided": np.array([p, *wilson(k, n, 1.645)]),
        "ninety-nine": np.array([p, *wilson(k, n, 2.576)]),
        "n-less-one": lambda: right * n / (n - 1) if n > 1 else np.full(3, np.nan),
        "per-cent": 100 * right,
    }


row.at_least_0(success="True or False", answer="a fraction is")


@row.right  # As the roots of the quadratic.
def _(success):
    n = len(success)
    p = np.mean(success)
    z2 = 1.96**2
    a, b, c = 1 + z2 / n, -(2 * p + z2 / n), p**2
    root = np.sqrt(max(b * b - 4 * a * c, 0.0))
    return np.array([p, (-b - root) / (2 * a), (-b + root) / (2 * a)])


@row.right  # Day 12's own, and np.count_nonzero.
def _(success):
    from robo47.planning import wilson_interval as of_day_12

    k = np.count_nonzero(success)
    return np.append(k / success.size, of_day_12(k, success.size))
