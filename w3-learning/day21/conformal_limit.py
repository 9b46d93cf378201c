"""21.5 `conformal_limit(scores, share)`: its questions and its mistakes."""

from math import ceil, floor
from statistics import NormalDist

import numpy as np

from labkit.judge import Row, Scalar

row = Row(Scalar(called="the limit"))
# Sizes and fractions whose (n + 1) (1 - share) is whole in floating point as well.
EVEN = ((19, 0.05), (18, 0.05), (39, 0.05), (9, 0.1), (3, 0.25), (7, 0.5), (1, 0.5))


@row.inputs
def _(rng):
    yield np.array([3.0, 1, 2]), 0.5
    for n, share in EVEN:
        yield rng.numbers(0, 1, n), share
    yield np.zeros(0), 0.05
    yield rng.numbers(0, 1, 5), 0.0
    yield rng.numbers(0, 1, 1), 0.7
    for n, share in ((5, 0.3), (5, 0.8), (11, 0.13), (24, 0.21), (60, 0.05), (6, 0.12)):
        yield rng.numbers(-2, 2, n), share


def too_few(scores, share):
    """Return whether there are too few scores for a finite limit."""
    return (len(scores) + 1) * (1 - share) > len(scores)


row.cases(
    data_with_too_few_scores=too_few,
    data_with_enough_scores=lambda scores, share: not too_few(scores, share),
)


@row.rare
def _(rng):
    yield rng.numbers(0, 1, 4), 0.11
    yield rng.numbers(0, 1, 8), 0.33


@row.wrongs
def _(scores, share):
    """quantile: your function interpolates a quantile of the n scores, as np.quantile
      does. Return the k-th smallest score, k = ceil((n + 1) (1 - share))
    clamped: your function returns the largest score if there are too few scores. Return
      infinity, because no smaller limit has the guarantee
    floor: your code rounds the rank down. Round it up, so that a new score exceeds the
      limit with a probability of at most `share`
    n-scores: your rank is ceil(n (1 - share)). Use n + 1, because the new score has one
      of n + 1 ranks
    largest: your function returns the largest score. Return the k-th smallest score, k
      = ceil((n + 1) (1 - share))
    share-of-the-small: your limit has the fraction `share` of the scores below it. Only
      this fraction of new scores should be above the limit, so use 1 - share
    counted-from-0: your limit is one rank too high. The k-th smallest of the sorted
      scores has the index k - 1
    gaussian: your limit assumes that the scores have a normal distribution. Use the
      rank of the scores, which needs no assumption about the distribution
    """
    n = len(scores)
    ranked = np.append(np.sort(scores), np.inf)

    def ranked_at(k):
        return ranked[min(max(k, 1), n + 1) - 1]

    exact = (n + 1) * (1 - share)
    k = ceil(exact)
    largest = np.max(scores, initial=-np.inf)
    normal = NormalDist().inv_cdf(1 - share) if 0 < share < 1 else np.inf
    return {
        "quantile": np.quantile(scores, 1 - share) if n else np.nan,
        "clamped": min(ranked_at(k), largest),
        "floor": ranked_at(floor(exact)),
        "n-scores": ranked_at(ceil(n * (1 - share))),
        "largest": largest,
        "share-of-the-small": ranked_at(ceil((n + 1) * share)),
        "counted-from-0": ranked_at(k + 1),
        "gaussian": np.mean(scores) + normal * np.std(scores) if n else np.nan,
    }


@row.right  # By counting ranks.
def _(scores, share):
    n = len(scores)
    for limit in sorted(scores):
        below = np.sum(scores <= limit)
        if below >= (n + 1) * (1 - share):
            return limit
    return np.inf


@row.right  # With infinity as one more score.
def _(scores, share):
    with_new = np.sort(np.append(scores, np.inf))
    k = ceil((len(scores) + 1) * (1 - share))
    return with_new[min(k, len(with_new)) - 1]


@row.spans
def _(rng):
    yield 1e-4 * rng.numbers(0, 1, 60), 0.05
    yield 1e4 * rng.numbers(0, 1, 300), 0.013


row.at_least_0(share="a probability")
