"""21.8 `compare_all(success)`: its questions and its mistakes."""

from itertools import pairwise

import numpy as np

from labkit.judge import Mask, Row, Vector
from robo47.evaluation import holm, sign_test

row = Row(
    (
        Vector((None,), called="the array of p-values"),
        Mask((None,), called="the mask of differences"),
    )
)


SORTED = "its p-values are in ascending order"


def policies(rng, n, *better):
    """Return successes of a first policy, and of others that it beats by some starts.

    Each of `better` has the wins and losses of the first policy against another one.
    """
    first = np.arange(n) < n // 2
    some = [first]
    for win, lose in better:
        other = first.copy()
        other[:win] = False
        other[n - lose :] = True
        some.append(other)
    return np.array(some)[:, rng.permutation(n)]


@row.inputs
def _(rng):
    yield (policies(rng, 20, (9, 0)),)
    yield (policies(rng, 40, (14, 2), (9, 3), (0, 0)),)
    yield (policies(rng, 40, (10, 2), (10, 2), (11, 2)),)  # .0386: Holm finds none
    yield (policies(rng, 30, (7, 0), (6, 0)),)  # .0156 and .0313
    yield (policies(rng, 30, (6, 0), (6, 0)),)
    yield (policies(rng, 30, (0, 8), (3, 3)),)
    yield (policies(rng, 20, (0, 9)),)
    yield (policies(rng, 40, (8, 1)),)  # .039: below .05, above .05 / 2
    yield (policies(rng, 40, (9, 0), (8, 0), (8, 1)),)  # Holm finds all of them
    yield (policies(rng, 40, (10, 2), (8, 0), (9, 1)),)  # .0386, .0078 and .0215
    yield (policies(rng, 30, (1, 9), (0, 6), (5, 1)),)
    yield (policies(rng, 40, (12, 1), (10, 2), (9, 2), (1, 7)),)
    yield (rng.random((2, 9)) < 0.5,)
    yield (policies(rng, 40, (9, 0), (7, 0), (6, 0)),)  # one limit for all finds two
    yield (policies(rng, 40, (9, 1), (3, 0)),)  # .022 is below .05 / 2, above .05 / 3
    yield (policies(rng, 40, (3, 0), (7, 0), (1, 1)),)  # .016
    yield (policies(rng, 40, (8, 1), (9, 1), (0, 9)),)  # .039, .022 and .004
    yield (policies(rng, 40, (8, 1), (11, 1), (8, 1), (10, 0)),)
    for k in (3, 4, 5):
        yield (policies(rng, 40, *rng.integers(0, 15, (k - 1, 2))),)


@row.rare
def _(rng):
    near = np.array([(6, 0), (7, 0), (8, 0), (8, 1), (9, 1), (10, 2), (0, 7)])
    for k in (2, 3, 4):
        yield (policies(rng, 40, *rng.choice(near, k)),)


row.cases(
    two_policies=lambda success: len(success) == 2,
    more_than_two_policies=lambda success: len(success) > 2,
)


def pairs(first, others):
    """Return p-values by the sign test."""
    return np.array([sign_test(first, other) for other in others])


def tosses(wins, losses):
    """Return the p-value of the sign test of some wins and losses."""
    won = np.arange(wins + losses) < wins
    return sign_test(won, ~won)


def unpaired(a, b):
    """Return a p-value as if the starts were not the same (the normal distribution)."""
    from math import erfc, sqrt

    n, mean = len(a), (a.mean() + b.mean()) / 2
    spread = sqrt(2 * mean * (1 - mean) / n)
    return erfc(abs(a.mean() - b.mean()) / spread / sqrt(2)) if spread else 1.0


@row.wrongs(hidden=dict.fromkeys(("mask-sorted", "sorted"), SORTED))
def _(success):
    """uncorrected: your code compares each p-value with 0.05. Use Holm's limits
      instead, because several comparisons make a false positive more probable
    bonferroni: your code compares each p-value with 0.05 / (k - 1). Use this limit only
      for the smallest p-value. Use 0.05 / (k - 2) for the next p-value, and so on
    bonferroni 2: your code compares each p-value with 0.05 / k. Use the limit 0.05 / (k
      - 1) for the smallest p-value, 0.05 / (k - 2) for the next p-value, and so on
    false-discovery: your code uses the method of Benjamini and Hochberg, which limits
      the expected fraction of false positives among the reported differences. Use
      Holm's method instead, which limits the probability of any false positive
    smallest-only: your code compares only the smallest p-value with its limit. Continue
      with the next p-value, and stop at the first p-value that is above its limit
    by-place: your code assigns Holm's limits in the order of the rows. Sort the
      p-values first, because the smallest p-value has the smallest limit
    mask-sorted: your function returns the mask in the order of the sorted p-values.
      Return the mask in the order of the policies instead
    against-the-next: your code compares each policy with the next policy. Compare the
      first policy with each of the others instead
    with-itself: your code includes the comparison of the first policy with itself in
      Holm's method. Include only the k - 1 comparisons with the other policies
    against-the-best: your code compares the policy that has the most successes with the
      others. Compare the first policy with the others instead, because it was chosen
      before the test
    unpaired: your code compares the success rates as if the policies had been tested on
      different starts. Use the sign test instead, because all policies are tested on
      the same starts
    against-the-last: your code compares the last policy with the others. Compare the
      first policy with each of the others instead
    does-not-stop: your code continues after the first p-value that is above its limit.
      Stop at this p-value, because no larger p-value is significant either
    adjusted: your function returns p-values that are corrected for the number of
      comparisons. Return the p-values of the sign test, because Holm's method changes
      only the limits
    only-if-better: your code reports a significant difference only if the first policy
      is better. Report one in the other direction as well
    all-successes: your code compares the total numbers of successes of both policies.
      Use only the starts on which exactly one of the two policies succeeds
    one-sided: your p-values are one-sided. Use the two-sided sign test instead, because
      the first policy can also be worse
    own-row: your function also compares the first policy with itself, so it returns k
      entries. Return only the k - 1 comparisons with the others
    columns: your code treats each column of `success` as a policy. Treat each row as a
      policy instead, because each column is a start
    sorted: your function returns the p-values in ascending order. Return the p-values
      in the order of the policies instead
    every-pair: your function compares all pairs of policies. Return only the k - 1
      comparisons of the first policy with the others
    all-pairs: your code corrects for all pairs of policies. Correct only for the k - 1
      comparisons with the first policy
    """
    p = pairs(success[0], success[1:])
    best = np.argmax(success.sum(axis=1))
    of_best = pairs(success[best], np.delete(success, best, axis=0))
    following = np.array([sign_test(*two) for two in pairwise(success)])
    apart = np.array([unpaired(success[0], other) for other in success[1:]])
    every = [
        sign_test(success[i], success[j])
        for i in range(len(success))
        for j in range(i + 1, len(success))
    ]
    of_columns = pairs(success[:, 0], success.T[1:])
    last = pairs(success[-1], success[:-1])
    rank = np.argsort(np.argsort(p, kind="stable"), kind="stable")
    multiplied = p * (len(p) - rank)
    fewest = p <= 0.05 * (rank + 1) / len(p)  # by Benjamini and Hochberg
    adjusted = [np.max(multiplied[rank <= r]) for r in rank]
    better = success[0].sum() > success[1:].sum(axis=1)
    sums = success.sum(axis=1)
    tossed = np.array([tosses(sums[0], some) for some in sums[1:]])
    return {
        "uncorrected": (p, p <= 0.05),
        "bonferroni": (p, p <= 0.05 / len(p)),
        "bonferroni 2": (p, p <= 0.05 / len(success)),
        "false-discovery": (p, np.array([np.any(fewest[rank >= r]) for r in rank])),
        "smallest-only": (p, (rank == 0) & holm(p)),
        "by-place": (p, p <= 0.05 / np.arange(len(p), 0, -1)),
        "mask-sorted": (p, holm(np.sort(p))),
        "against-the-next": (following, holm(following)),
        "with-itself": (p, holm(np.append(1.0, p))[1:]),
        "against-the-best": (of_best, holm(of_best)),
        "unpaired": (apart, holm(apart)),
        "against-the-last": (last, holm(last)),
        "does-not-stop": (p, multiplied <= 0.05),
        "adjusted": (np.minimum(adjusted, 1), holm(p)),
        "only-if-better": (p, holm(p) & better),
        "all-successes": (tossed, holm(tossed)),
        "one-sided": (p / 2, holm(p / 2)),
        "own-row": (np.append(1, p), holm(np.append(1, p))),
        "columns": (of_columns, holm(of_columns)),
        "sorted": (np.sort(p), holm(np.sort(p))),
        "every-pair": (np.array(every), holm(every)),
        "all-pairs": (p, holm(every)[: len(p)]),
    }


@row.right  # By McNemar's binomial sum and adjusted p-values.
def _(success):
    from math import comb

    k = len(success)
    p = np.ones(k - 1)
    for i in range(k - 1):
        win = int(np.sum(success[0] > success[i + 1]))
        lose = int(np.sum(success[0] < success[i + 1]))
        d = win + lose  # starts that differ
        tail = sum(comb(d, j) for j in range(min(win, lose) + 1))
        p[i] = min(1.0, 2 * tail / 2**d)
    order = np.argsort(p)
    adjusted = np.maximum.accumulate(p[order] * np.arange(k - 1, 0, -1))
    different = np.zeros(k - 1, dtype=bool)
    different[order] = adjusted <= 0.05
    return p, different


@row.right  # With a loop that stops.
def _(success):
    p = [sign_test(success[0], success[i]) for i in range(1, len(success))]
    different = np.full(len(p), False)
    left = len(p)  # comparisons that are left
    for i in np.argsort(p, kind="stable"):
        if p[i] > 0.05 / left:
            break
        different[i] = True
        left = left - 1
    return np.array(p), different


@row.spans
def _(rng):
    yield (policies(rng, 200, (60, 20), (30, 15)),)


row.at_least_0(success="True or False", answer="probabilities, and True or False")
