"""18.6 `paired_power(win, lose, n, level)`: its questions and its mistakes."""

from math import comb, erfc, sqrt
from statistics import NormalDist

import numpy as np

from labkit.judge import Row, Scalar

from .gap_by_luck import pmf

row = Row(Scalar())


@row.inputs
def _(rng):
    yield 0.5, 0.25, 6, 0.05
    yield 0.5, 0.5, 5, 0.0625  # p meets the level
    yield 0.0, 0.0, 4, 0.05
    yield 0.6, 0.0, 7, 0.05
    yield 0.0, 0.4, 8, 0.1
    yield 0.3, 0.2, 9, 0.5
    for _ in range(5):
        win, lose = rng.numbers(0.1, 0.5, 2)
        level = float(rng.choice([0.05, 0.1, 0.2]))
        yield float(win), float(lose), int(rng.integers(5, 12)), level


row.cases(
    policies_that_differ_on_every_start=lambda win, lose, n, level: win + lose == 1,
    policies_that_agree_on_some_starts=lambda win, lose, n, level: win + lose < 1,
)


@row.rare
def _(rng):
    win = float(rng.numbers(0.1, 0.9))
    yield win, 1 - win, int(rng.integers(5, 12)), 0.2


def p_values(d):
    """Return the p-values of the sign test for 0 to d wins of d."""
    few = np.cumsum([comb(d, k) for k in range(d + 1)])
    return [min(1.0, 2 * int(few[min(k, d - k)]) / 2**d) for k in range(d + 1)]


def power(win, lose, n, level, p_of=p_values, reported=lambda k, d: True):
    """Return the power with another p-value, or where only some wins are reported."""
    differ = win + lose
    share = win / differ if differ else 0.0
    found = 0.0
    for d, chance in enumerate(pmf(n, min(differ, 1.0))):
        for k, (p, part) in enumerate(zip(p_of(d), pmf(d, share), strict=True)):
            found += chance * part * (p <= level and reported(k, d))
    return found


def approximate(d):
    """Return the p-values by the normal approximation."""
    return [erfc(abs(2 * k - d) / sqrt(2 * d)) if d else 1.0 for k in range(d + 1)]


def one_tail(d):
    """Return the p-values of one side, for 0 to d wins."""
    return [sum(comb(d, i) for i in range(k, d + 1)) / 2**d for k in range(d + 1)]


def normal_power(win, lose, n, level):
    """Return the power by the normal approximation of McNemar's test."""
    differ, gap = win + lose, abs(win - lose)
    if differ == 0:
        return 0.0
    rest = differ - gap**2  # the variance of one start's difference
    z = NormalDist().inv_cdf(1 - level / 2)
    over = gap * sqrt(n) - z * sqrt(differ)
    return NormalDist().cdf(over / sqrt(rest)) if rest > 0 else float(over > 0)


def chosen_from_all(win, lose, n, level):
    """Return the sum over wins and losses, each of them chosen from all n starts."""
    tie = max(1 - win - lose, 0.0)
    return sum(
        comb(n, k) * comb(n, j) * win**k * lose**j * tie ** (n - k - j)
        for k in range(n + 1)
        for j in range(n + 1 - k)
        if p_values(k + j)[k] <= level
    )


@row.wrongs
def _(win, lose, n, level):
    """all-pairs-differ: your code assumes that the outcomes of the two policies differ
      on all n starts. The number of starts with different outcomes is random, so sum
      over all possible values of this number
    expected-number: your code uses only the rounded expected number of starts with
      different outcomes. The number of these starts is random, so sum over all possible
      values of this number
    first-only: your code includes only reported differences in favour of the first
      policy. The sign test is two-sided, so include reported differences in both
      directions
    one-sided: your code uses a one-sided p-value. Use the two-sided p-value of
      `sign_test` instead
    independent: your code treats the numbers of wins and losses as independent, but a
      start cannot be both. Sum over the number of starts where the two outcomes differ,
      and then over the number of wins among these starts
    win-as-share: your code uses `win` as the probability of a win on a start where the
      two outcomes differ. Use win / (win + lose) instead, which is the probability of a
      win given that the outcomes differ
    fair-share: your code uses 1/2 as the probability of a win on a start where the two
      outcomes differ, as if both policies were equally good. Use win / (win + lose)
      instead
    normal: your code uses a normal approximation of the p-value. Use the exact p-value
      of `sign_test` instead
    normal-power: your function uses a normal approximation of the power. Sum the
      probabilities of all numbers of wins and losses for which the p-value is at most
      `level`
    level-fixed: your code compares the p-value with 0.05. Compare the p-value with the
      argument `level` instead
    equal-numbers: your code assigns the same probability to every possible number of
      starts with different outcomes. This number has a binomial distribution with n
      trials and the probability win + lose
    chosen-from-all: your binomial coefficient chooses the losses from all n starts.
      Choose the losses from the starts that are not wins, because a start cannot be
      both a win and a loss
    """
    differ = win + lose
    share = win / differ if differ else 0.0
    whole = round(n * differ)

    def given(d):
        found = zip(p_values(d), pmf(d, share), strict=True)
        return sum(part for p, part in found if p <= level)

    def independent():
        one, two = pmf(n, win), pmf(n, lose)
        return sum(
            one[k] * two[j] * (p_values(k + j)[k] <= level)
            for k in range(n + 1)
            for j in range(n + 1)
        )

    def with_share(x):
        chances = pmf(n, min(differ, 1.0))
        seen = ((c, d, p_values(d), pmf(d, x)) for d, c in enumerate(chances))
        return sum(c * sum(q[k] for k in range(d + 1) if p[k] <= level)
                   for c, d, p, q in seen)  # fmt: skip

    return {
        "all-pairs-differ": given(n),
        "expected-number": given(whole),
        "first-only": power(win, lose, n, level, reported=lambda k, d: 2 * k > d),
        "one-sided": power(win, lose, n, level, one_tail),
        "independent": independent(),
        "win-as-share": with_share(win),
        "fair-share": with_share(0.5),
        "normal": power(win, lose, n, level, approximate),
        "normal-power": normal_power(win, lose, n, level),
        "level-fixed": power(win, lose, n, 0.05),
        "equal-numbers": sum(map(given, range(n + 1))) / (n + 1),
        "chosen-from-all": chosen_from_all(win, lose, n, level),
    }


@row.right  # A double sum over wins and losses.
def _(win, lose, n, level):
    found = 0.0
    for k in range(n + 1):
        for j in range(n + 1 - k):
            tail = sum(comb(k + j, i) for i in range(min(k, j) + 1))
            if min(1, 2 * tail / 2 ** (k + j)) <= level:
                ways = comb(n, k) * comb(n - k, j)
                found += (
                    ways * win**k * lose**j * max(1 - win - lose, 0.0) ** (n - k - j)
                )
    return found


@row.right  # With the sign test of starts that are written down.
def _(win, lose, n, level):
    differ = win + lose
    if differ == 0:
        return 0.0

    def p_of(k, d):
        first = np.arange(d) < k
        few = min(int(first.sum()), int((~first).sum()))
        return min(1.0, 2 * sum(comb(d, i) for i in range(few + 1)) / 2**d)

    total = 0.0
    for d in range(n + 1):
        of_d = comb(n, d) * differ**d * max(1 - differ, 0.0) ** (n - d)
        for k in range(d + 1):
            of_k = comb(d, k) * (win / differ) ** k * (lose / differ) ** (d - k)
            total += of_d * of_k * (p_of(k, d) <= level)
    return total


@row.spans
def _(rng):
    yield 0.22, 0.06, 100, 0.05
    yield 6e-4, 2e-4, 20, 0.5  # a guard of 0.001 would make it 0


row.at_least_0(
    win="a probability",
    lose="a probability",
    n="a number",
    level="a probability",
    answer="a probability",
)
row.same(
    "first = win / differ if differ > 0 else 0.0 => "
    "first = win / differ if differ > 0 else 1",
    "no start differs then",
)
row.same(
    "p = np.minimum(1, 2 * few[np.minimum(k, d - k)]) => "
    "p = np.minimum(2, 2 * few[np.minimum(k, d - k)])",
    "a level is below 1",
)
