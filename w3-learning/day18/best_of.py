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
    """mean: your function returns the expected success rate of a single policy. Return
      the expected success rate of the best of k policies instead
    any-success: your function returns the probability of at least one success on k
      starts. Return the expected value of the largest of the k numbers of successes,
      divided by n
    all-succeed: your function returns the probability that at least one of k policies
      succeeds on all n starts. Return the expected value of the largest of the k
      numbers of successes, divided by n
    worst: your function returns the expected success rate of the worst policy. The best
      policy has at most s successes with probability F(s)^k, where F is the binomial
      distribution function
    one-fewer: your function returns the expected success rate of the best of k - 1
      policies. The probability that all k policies have at most s successes is F(s)^k,
      where F is the binomial distribution function
    times-k: your code multiplies the binomial distribution function F by k. The
      probability that all k policies have at most s successes is F(s)^k, because the
      policies are independent
    times-k 2: your code multiplies the binomial distribution function F by k and limits
      the product to 1. Use F(s)^k, the probability that all k policies have at most s
      successes
    density: your code uses k * F^(k - 1) * f, which is the density of the maximum of k
      continuous variables. The largest number of successes is discrete: this number is
      s with probability F(s)^k - F(s - 1)^k
    possible-numbers: your code divides the expected number of successes by n + 1.
      Divide this number by n instead, because each policy has n starts
    median: your function returns the median of the largest of the k numbers of
      successes, divided by n. Return the expected value of this number, divided by n
    normal: your function uses the normal approximation p + sqrt(2 * ln(k) * p * (1 - p)
      / n). Compute the expected value with the exact binomial probabilities instead
    """
    cdf = np.cumsum(pmf(n, p))
    below = np.minimum(cdf[:n], 1.0)
    return {
        "mean": p,
        "any-success": 1 - (1 - p) ** k,
        "all-succeed": 1 - (1 - p**n) ** k,
        "worst": np.sum((1 - below) ** k) / n,
        "one-fewer": np.sum(1 - below ** (k - 1)) / n,
        "times-k": np.sum(1 - k * below) / n,
        "times-k 2": np.sum(1 - np.minimum(1.0, k * below)) / n,
        "density": np.arange(n + 1) @ (k * cdf ** (k - 1) * pmf(n, p)) / n,
        "possible-numbers": np.sum(1 - below**k) / (n + 1),
        "median": np.sum(below**k < 0.5) / n,
        "normal": p + np.sqrt(2 * np.log(k) * p * (1 - p) / n),
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
