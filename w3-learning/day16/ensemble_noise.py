"""16.8 `ensemble_noise(k, decay)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Scalar

row = Row(Scalar())


@row.inputs
def _(rng):
    yield 8, 0.01
    for k, decay in ((1, 0.5), (2, 0.0), (4, 0.0), (3, 0.3), (5, -0.4), (6, 1.2)):
        yield k, decay
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
    """root-forgotten: your result is the variance of the mean. Take its square root
    equal-weights: your result is 1 / sqrt(k), which holds for equal weights only
    sum-not-squared: your result is the root of the sum of the weights, which is 1. The
      variances are multiplied by the squares of the weights
    not-normalised: in your code, the weights are not divided by their sum
    mean-of-squares: your function takes the mean of the squared weights. Independent
      variances add up: take the sum
    added: in your code, the standard deviations are added. Independent errors have
      variances that add up
    """
    w = np.exp(-decay * np.arange(k))
    n = w / w.sum()
    return {
        "root-forgotten": np.sum(n**2),
        "equal-weights": 1 / np.sqrt(k),
        "sum-not-squared": 1.0,
        "not-normalised": np.sqrt(np.sum(w**2)),
        "mean-of-squares": np.sqrt(np.mean(n**2)),
        "added": np.sum(n) + 0 * k,
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
