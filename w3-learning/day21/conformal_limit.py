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
    yield np.array([0.4, 0.9, 0.4, 0.1, 0.4, 0.7, 0.4, 0.4]), 0.42  # equal scores
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


@row.wrongs(
    hidden={
        "interpolated 2": "hardly any of its scores is between the two scores",
        "nan-if-few": "no score is above NaN, as none is above infinity",
        "without-ties": "all of its scores are different",
    }
)
def _(scores, share):
    """quantile: your function interpolates a quantile of the n scores, as np.quantile
      does. Return a score or infinity. How many ranks can a new score have among the n
      scores?
    quantile 2: your function rounds a quantile of the n scores up to a score. This
      quantile ignores the new score. How many ranks can a new score have among the n
      scores?
    clamped: your function returns the largest score if there are too few scores. Return
      infinity instead, because no finite limit has the guarantee
    clamped 2: your function returns the largest score if there are too few scores.
      Return infinity instead, because no finite limit has the guarantee
    floor: your code rounds the rank down. Round the rank up instead, so that a new
      score exceeds the limit with a probability of at most `share`
    floor 2: your code rounds the rank down. Round the rank up instead, so that a new
      score exceeds the limit with a probability of at most `share`
    n-scores: your code uses the rank ceil(n * (1 - share)). Replace n by n + 1, because
      the new score has one of n + 1 ranks
    largest: your function returns the largest score. Return the smallest of the scores
      that a new score exceeds with a probability of at most `share`
    share-of-the-small: your code uses `share` as the fraction of the scores below the
      limit. Use 1 - share instead, because `share` is the fraction above the limit
    counted-from-0: your limit is one rank too high. Ranks count from 1, but the indices
      of the sorted scores count from 0
    floor-plus-1: your code rounds the rank down and adds 1. Round the rank up instead,
      because your rank is too high if (n + 1) * (1 - share) is a whole number
    interpolated: your code interpolates between two scores, and returns the largest
      score if there are too few scores. Return one of the scores, and infinity if the
      rank of the limit is above n
    interpolated 2: your rank is correct, but your code interpolates between two scores.
      Return the score that has this rank
    nan-if-few: your function returns NaN if there are too few scores. Return infinity
      instead, because no finite limit has the guarantee
    nan-if-few 2: your function returns -infinity if there are too few scores. Return
      infinity instead, which no score exceeds
    infinite-too-soon: your function returns infinity even if the rank of the limit is
      n. Return the largest score in this case, and infinity only for a rank above n
    without-ties: your code removes duplicate scores. Keep all n scores, because each
      score has its own rank
    gaussian: your code computes the limit as for a normal distribution. Use the ranks
      of the scores instead, because the distribution of the scores is unknown
    """
    n = len(scores)
    ranked = np.append(np.sort(scores), np.inf)

    def ranked_at(k):
        return ranked[min(max(k, 1), n + 1) - 1]

    exact = (n + 1) * (1 - share)
    k = ceil(exact)
    largest = np.max(scores, initial=-np.inf)
    normal = NormalDist().inv_cdf(1 - share) if 0 < share < 1 else np.inf
    level = min(1, k / n) if n else 1
    between = np.quantile(scores, level) if n else np.inf
    unique = np.unique(scores)
    return {
        "quantile": np.quantile(scores, 1 - share) if n else np.nan,
        "quantile 2": np.quantile(scores, 1 - share, method="higher") if n else np.inf,
        "clamped": min(ranked_at(k), largest),
        "clamped 2": ranked_at(min(k, n)),
        "floor": ranked_at(floor(exact)),
        "floor 2": ranked_at(floor(exact) or n + 1),
        "floor-plus-1": ranked_at(floor(exact) + 1),
        "interpolated": between,
        "interpolated 2": between if k <= n else np.inf,
        "nan-if-few": ranked_at(k) if k <= n else np.nan,
        "nan-if-few 2": ranked_at(k) if k <= n else -np.inf,
        "infinite-too-soon": ranked_at(k) if k < n else np.inf,
        "without-ties": np.append(unique, np.inf)[
            min(ceil((len(unique) + 1) * (1 - share)), len(unique) + 1) - 1
        ],
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
