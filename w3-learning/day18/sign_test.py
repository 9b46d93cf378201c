"""18.4 `sign_test(first, second)`: its questions and its mistakes."""

from math import comb, erfc, sqrt

import numpy as np

from labkit.judge import Row, Scalar

row = Row(Scalar())


def starts(rng, win, lose, both, none):
    """Return two policies' successes: so many starts of each kind, in any order."""
    kinds = rng.permutation(np.repeat([0, 1, 2, 3], [win, lose, both, none]))
    return (kinds == 0) | (kinds == 2), (kinds == 1) | (kinds == 2)


@row.inputs
def _(rng):
    for win, lose, both, none in (
        (6, 1, 0, 0),
        (0, 5, 1, 1),
        (0, 0, 2, 1),  # nobody differs
        (2, 2, 1, 0),  # an even split
        (3, 2, 0, 0),
        (0, 1, 2, 0),
        (7, 0, 0, 0),
        (0, 0, 0, 1),
    ):
        yield starts(rng, win, lose, both, none)
    for _ in range(8):
        yield starts(rng, *rng.integers(0, 7, 4))


def differ(first, second):
    """Return the number of starts on which the policies differ."""
    return int(np.sum(first != second))


row.cases(
    {
        "policies that differ on every start": lambda a, b: differ(a, b) == len(a),
        "policies that agree on some starts": lambda a, b: differ(a, b) < len(a),
    }
)
row.cases(
    {
        "pairs in which the first policy wins more often": lambda a, b: (
            a.sum() > b.sum()
        ),
        "pairs in which the second policy wins more often": lambda a, b: (
            a.sum() < b.sum()
        ),
        "pairs with as many wins as losses": lambda a, b: a.sum() == b.sum(),
    }
)


@row.rare
def _(rng):
    yield starts(rng, *rng.integers(1, 7, 2), 0, 0)
    k = int(rng.integers(1, 6))
    yield starts(rng, k, k, *rng.integers(0, 4, 2))


def upto(k, d):
    """Return the probability of at most k heads of d coins."""
    return sum(comb(d, i) for i in range(k + 1)) / 2**d


@row.wrongs
def _(first, second):
    """strict: your code sums only the probabilities of splits that are more uneven than
      the observed split. Include the observed split, because the p-value covers all
      splits that are at least as uneven
    strict 2: your code sums only the probabilities of splits that are more uneven than
      the observed split, unless the observed split is even. Always include the observed
      split
    wins-only: your code sums the probabilities up to the number of wins, even if there
      are fewer losses. End the sum at the smaller of the numbers of wins and losses
      instead
    four-times: your p-value is four times the probability of one tail. Use twice this
      probability instead, because there are two tails
    zero-if-none: your p-value is 0 if the policies differ on no start. In this case
      there is no evidence of a difference, so return 1
    every-win: your code counts each start on which the policies differ as a win for the
      first policy. Count such a start as a loss if only the second policy succeeds
    one-sided: your p-value contains only one tail. Include the other tail as well,
      because a split that is equally uneven in favour of the other policy is just as
      extreme
    first-better: your function returns the probability that the first policy has at
      least the observed number of wins. The test is two-sided, so return twice the
      smaller tail, but at most 1
    not-capped: your p-value is above 1 for an even split, because both tails include
      the even split. Limit the p-value to 1
    all-starts: your code uses n trials in the binomial distribution, one for each
      start. Use only the starts on which exactly one policy succeeds
    agreement: your code treats each start on which the two policies agree as half a
      win. Omit these starts, because such a start favours neither policy
    agreement 2: your code treats half of the starts on which the two policies agree as
      wins, and the other half as losses. Omit these starts, because such a start
      favours neither policy
    both-win: your code counts each start on which the two policies agree as a win and
      also as a loss. Omit these starts, because such a start favours neither policy
    one-split: your p-value is twice the probability of the observed split alone. Also
      include the probabilities of all splits that are more uneven
    mid-p: your p-value includes only half of the probability of the observed split (the
      mid-p-value). Include this probability in full
    all-successes: your code compares the total numbers of successes of the two
      policies. Omit the starts on which both policies succeed, because such a start
      favours neither policy
    chi-squared: your function uses the chi-squared approximation of McNemar's test. Sum
      the exact binomial probabilities instead, because the approximation is inaccurate
      for few starts
    continuity: your function uses the chi-squared approximation of McNemar's test with
      a continuity correction. Sum the exact binomial probabilities instead
    paired-z: your function uses a z-test for the mean difference. Sum the exact
      binomial probabilities instead, because the normal approximation is inaccurate for
      few starts
    unpaired: your function compares the two success rates as if the policies had been
      tested on different starts. Both policies are tested on the same starts, so use
      only the starts on which exactly one policy succeeds
    """
    win, lose = int(np.sum(first & ~second)), int(np.sum(second & ~first))
    d, n, k = win + lose, len(first), min(win, lose)
    ties = (n - d) // 2
    both = int(np.sum(first & second))
    chi = abs(win - lose) / sqrt(d) if d else 0.0
    corrected = max(abs(win - lose) - 1, 0) / sqrt(d) if d else 0.0
    a, b = np.mean(first), np.mean(second)
    error = np.std(first.astype(float) - second) / sqrt(n)
    ratio = abs(a - b) / error if error else 100.0 * abs(a - b)
    spread = sqrt((a + b) / 2 * (1 - (a + b) / 2) * 2 / n)
    z = abs(a - b) / spread if spread else 0.0
    return {
        "strict": min(1.0, 2 * upto(k - 1, d)),
        "strict 2": min(1.0, 2 * upto(k - 1, d)) if win != lose else 1.0,
        "wins-only": min(1.0, 2 * upto(win, d)),
        "four-times": min(1.0, 4 * upto(k, d)),
        "zero-if-none": min(1.0, 2 * upto(k, d)) * (d > 0),
        "every-win": min(1.0, 2 / 2**d),
        "one-sided": upto(k, d),
        "first-better": upto(lose, d),
        "not-capped": 2 * upto(k, d),
        "all-starts": min(1.0, 2 * upto(k, n)),
        "agreement": min(1.0, 2 * upto(k + ties, n)),
        "agreement 2": min(1.0, 2 * upto(k + ties, d + 2 * ties)),
        "both-win": min(1.0, 2 * upto(k + n - d, 2 * n - d)),
        "one-split": min(1.0, 2 * comb(d, k) / 2**d),
        "mid-p": min(1.0, 2 * upto(k - 1, d) + comb(d, k) / 2**d),
        "all-successes": min(1.0, 2 * upto(k + both, d + 2 * both)),
        "chi-squared": erfc(chi / sqrt(2)),
        "continuity": erfc(corrected / sqrt(2)),
        "paired-z": erfc(ratio / sqrt(2)),
        "unpaired": erfc(z / sqrt(2)),
    }


@row.right  # The sum over all splits that are at least as uneven.
def _(first, second):
    win = int(np.sum(first > second))
    lose = int(np.sum(first < second))
    d = win + lose  # starts that differ
    some = [k for k in range(d + 1) if abs(2 * k - d) >= abs(win - lose)]
    return sum(comb(d, k) for k in some) / 2**d


@row.right  # With one tail, and an even split apart.
def _(first, second):
    differ = first != second
    d = int(differ.sum())
    wins = int(first[differ].sum())
    if 2 * wins == d:
        return 1.0
    more = max(wins, d - wins)
    return sum(comb(d, k) for k in range(more, d + 1)) / 2 ** (d - 1)


@row.spans
def _(rng):
    yield starts(rng, 48, 10, 129, 13)


row.at_least_0(first="True or False", second="True or False", answer="a probability")
