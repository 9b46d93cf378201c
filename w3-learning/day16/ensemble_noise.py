"""16.8 `ensemble_noise(k, decay)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Scalar

row = Row(Scalar())


@row.inputs
def _(rng):
    yield 8, 0.01
    yield from ((1, 0.5), (2, 0.0), (4, 0.0), (3, 0.3), (5, -0.4), (6, 1.2))
    yield int(rng.integers(2, 9)), float(rng.numbers(-1, 1))


row.cases(
    one_plan=lambda k, decay: k == 1,
    several_plans=lambda k, decay: k > 1,
)
row.cases(
    equal_weights=lambda k, decay: decay == 0,
    weights_that_differ=lambda k, decay: decay != 0,
)


@row.wrongs
def _(k, decay):
    """equal-weights: your function returns 1 / sqrt(k), which is correct only for equal
      weights. Add the variances of the weighted errors instead, and take the square
      root of their sum
    sum-not-squared: your function returns the sum of the weights, which is always 1.
      Sum the squared weights instead, and take the square root of this sum
    effective-number: your function returns 1 / sum(w^2) for the weights w, which is the
      effective number of plans. Return the square root of sum(w^2) instead, which is
      the standard deviation of the weighted mean
    spread-of-the-weights: your function returns the standard deviation of the weights.
      Add the variances of the weighted errors instead, and take the square root of
      their sum
    """
    weights = np.exp(-decay * np.arange(k))
    weights = weights / weights.sum()
    return {
        "equal-weights": 1 / np.sqrt(k),
        "sum-not-squared": 1.0,
        "effective-number": 1 / np.sum(weights**2),
        "spread-of-the-weights": np.std(weights),
    }


@row.right  # The norm of the weights.
def _(k, decay):
    weights = np.exp(-decay * np.arange(k))
    return np.linalg.norm(weights / np.sum(weights))


@row.right  # Two sums in a loop.
def _(k, decay):
    total = squares = 0.0
    for i in range(k):
        weight = np.exp(-decay * i)
        total += weight
        squares += weight * weight
    return squares**0.5 / total


row.spans(k=(1, 100), decay=(0.0, -1.0, 3.0))
