"""18.7 `best_of(p, n, k)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Scalar

from .gap_by_luck import pmf

row = Row(Scalar())


@row.inputs
def _(rng):
    yield 0.75, 20, 6
    yield 0.5, 1, 2
    yield 0.3, 4, 1  # one policy
    yield 0.0, 3, 4
    yield 1.0, 3, 2
    for _ in range(6):
        p = float(rng.numbers(0.1, 0.9))
        yield p, int(rng.integers(2, 15)), int(rng.integers(2, 7))


row.cases(
    single_policies=lambda p, n, k: k == 1,
    several_policies=lambda p, n, k: k > 1,
)


@row.rare
def _(rng):
    yield float(rng.numbers(0.1, 0.9)), int(rng.integers(2, 15)), 1


@row.wrongs
def _(p, n, k):
    """mean: your result is the mean success rate. Return the expected rate of the
      best of k tests, which is larger
    any-success: your result is the probability of at least one success in k trials.
      Return the expected largest of k numbers of successes, divided by n
    all-succeed: your result is the probability that one of k policies succeeds on
      all n starts. Return the expected largest number of successes, divided by n
    worst: your result is the expected rate of the worst policy. The best policy has
      at most s successes if all k policies have at most s
    """
    cdf = np.cumsum(pmf(n, p))
    below = np.minimum(cdf[:n], 1.0)
    return {
        "mean": p,
        "any-success": 1 - (1 - p) ** k,
        "all-succeed": 1 - (1 - p**n) ** k,
        "worst": np.sum((1 - below) ** k) / n,
    }


@row.right  # By the distribution of the largest.
def _(p, n, k):
    below = np.cumsum(pmf(n, p)) ** k
    largest = np.diff(np.append(0.0, below))
    return largest @ np.arange(n + 1) / n


@row.right  # Summation by parts.
def _(p, n, k):
    some = np.cumsum(pmf(n, p))
    return 1 - sum(some[s] ** k for s in range(n)) / n


row.at_least_0(p="a probability", n="a number", k="a number", answer="a rate")
