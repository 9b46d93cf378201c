"""18.5 `gap_by_luck(p, n, gap)`: its questions and its mistakes."""

from math import comb, erfc, sqrt

import numpy as np

from labkit.judge import Row, Scalar

row = Row(Scalar())


def pmf(n, p):
    """Return the probabilities of 0 to n successes."""
    return np.array([comb(n, k) * p**k * (1 - p) ** (n - k) for k in range(n + 1)])


@row.inputs
def _(rng):
    yield 0.7, 50, 5
    yield 0.5, 1, 1
    yield 0.5, 2, 0
    yield 0.3, 4, 5  # more than there are starts
    yield 0.0, 3, 1
    yield 1.0, 3, 0
    for _ in range(6):
        n = int(rng.integers(3, 12))
        yield float(rng.numbers(0.1, 0.9)), n, int(rng.integers(1, n))


row.cases(
    gaps_of_0=lambda p, n, gap: gap == 0,
    gaps_above_0=lambda p, n, gap: gap > 0,
)


@row.rare
def _(rng):
    yield float(rng.numbers(0.1, 0.9)), int(rng.integers(3, 12)), 0


@row.wrongs(hidden={"one-direction-doubled": "the lab has no gap of 0"})
def _(p, n, gap):
    """rates-as-floats: your code compares the difference of the success rates with gap
      / n. Compare the difference of the numbers of successes with `gap` instead,
      because rounding errors in the rates can exclude some pairs
    one-direction: your code includes only the pairs of results in which the first test
      has at least `gap` more successes. Also include the pairs in which the second test
      has more successes
    one-set: your code compares the result of one test with the expected number of
      successes, n * p. The results of both tests are random, so sum over all pairs of
      results
    normal: your function uses a normal approximation. Sum the exact binomial
      probabilities instead, because the approximation is inaccurate for few starts
    half-a-start: your function uses a normal approximation with a continuity
      correction. Sum the exact binomial probabilities instead
    half-a-start 2: your function uses a normal approximation with a continuity
      correction, unless `gap` is 0. Sum the exact binomial probabilities instead
    one-direction-doubled: your code doubles the one-sided sum. If `gap` is 0, this
      doubling counts every pair of equal results twice. Count these pairs only once
    sum-of-both: your code uses the distribution of the sum of the two numbers of
      successes. Use the distribution of the difference of these numbers instead
    exactly: your code includes only the pairs of results whose difference is exactly
      `gap`. Include the pairs with a larger difference as well
    """
    k = np.arange(n + 1)
    one = pmf(n, p)
    apart = k[:, None] - k
    both = np.outer(one, one)
    rates = k[:, None] / n - k / n
    width = sqrt(2 * n * p * (1 - p))
    half = erfc((gap - 0.5) / width / sqrt(2)) if width else 0.0
    return {
        "rates-as-floats": np.sum(both[np.abs(rates) >= gap / n]),
        "one-direction": np.sum(both[apart >= gap]),
        "one-set": np.sum(one[np.abs(k - n * p) >= gap]),
        "normal": erfc(gap / width / sqrt(2)) if width else float(gap <= 0),
        "half-a-start": erfc((gap - 0.5) / width / sqrt(2)) if width else 0.5,
        "half-a-start 2": half if gap else 1.0,
        "one-direction-doubled": 2 * np.sum(both[apart >= gap]),
        "sum-of-both": np.sum(both[np.abs(k[:, None] + k - n) >= gap]),
        "exactly": np.sum(both[np.abs(apart) == gap]),
    }


@row.right  # The distribution of the difference, by convolution.
def _(p, n, gap):
    one = pmf(n, p)
    difference = np.convolve(one, one[::-1])  # the probabilities of -n to n
    return difference[np.abs(np.arange(-n, n + 1)) >= gap].sum()


@row.right  # A double loop.
def _(p, n, gap):
    one = pmf(n, p)
    found = 0.0
    for i in range(n + 1):
        for j in range(n + 1):
            if abs(i - j) >= gap:
                found += one[i] * one[j]
    return found


row.spans(p=(0.9, 0.02))


row.at_least_0(
    p="a probability", n="a number", gap="a number of starts", answer="a probability"
)
