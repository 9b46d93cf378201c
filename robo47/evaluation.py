"""Data and its evaluation: error growth, data sets, and exact tests of success rates.

Rows of data are (observation, action) pairs, and `episode` holds the number of the
episode of each row, as in `robo47.cloning`. Conventions of the tests:

- Every count is a whole number of starts, never a rate: 0.74 - 0.64 >= 0.1 is False in
  floating point.
- Probabilities are exact sums of binomial probabilities, not normal approximations.
- p is the probability of a result at least as extreme if both policies are equally
  good; a test with the level 0.05 reports a difference if p <= 0.05.

Sources: Ross and Bagnell, "Efficient reductions for imitation learning" (2010); Ross,
Gordon and Bagnell, "A reduction of imitation learning and structured prediction to
no-regret online learning" (2011), DAgger; McNemar, "Note on the sampling error of the
difference between correlated proportions or percentages" (1947); Holm, "A simple
sequentially rejective multiple test procedure" (1979).
"""

from math import comb
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from robo47 import checks
from robo47.checks import Array

Rows = tuple[Array, Array, NDArray[Any]]  # observation, action, episode
LEVEL = 0.05  # of `holm`: the probability of any false positive
MOST = 1000  # trials; more would overflow a binomial coefficient as a float


def error_after(a: float, step: float, T: int) -> float:
    """Return the error after T steps of e' = a e + step, from the error 0.

    Args:
        a: factor of the error from one step to the next; 1 if nothing corrects it.
        step: error that each step adds.
        T: number of steps, 0 or more.

    Returns:
        step (a^T - 1) / (a - 1), or step T for a = 1, in the unit of `step`.

    Raises:
        ValueError: a number that is not finite, or T not a whole number from 0.
    """
    a = float(checks.array(a, "a", ()))
    step = float(checks.array(step, "step", ()))
    powers = a ** np.arange(_count(T, "T"), dtype=np.float64)
    return float(step * np.sum(powers))  # as a sum it is accurate near a = 1


def aggregate(first: Rows, second: Rows) -> Rows:
    """Return two data sets as one, with separate episode numbers.

    Args:
        first, second: (observation (n, d), action (n, m), episode (n,)) each. The
            numbers of `second` begin at 0.

    Returns:
        The rows of `first`, then those of `second`, as such a triple. The largest
        number in `first`, plus 1, is added to each number of `second`.

    Raises:
        ValueError: shapes that do not match.
    """
    (seen, done, of), (seen_2, done_2, of_2) = map(_rows, (first, second))
    if seen.shape[1] != seen_2.shape[1] or done.shape[1] != done_2.shape[1]:
        raise ValueError(
            f"the rows of first have {seen.shape[1]} and {done.shape[1]} columns, of "
            f"second {seen_2.shape[1]} and {done_2.shape[1]}; expected the same"
        )
    shift = of.max() + 1 if len(of) else 0
    return (
        np.vstack([seen, seen_2]),
        np.vstack([done, done_2]),
        np.concatenate([of, of_2 + shift]),
    )


def episode_weights(episode: ArrayLike) -> Array:
    """Return a weight for each row, so that each episode has the same total weight.

    Args:
        episode: number of each row's episode, (n,).

    Returns:
        (n,), inversely proportional to the length of the row's episode; their mean
        is 1.

    Raises:
        ValueError: no vector.
    """
    episode = np.asarray(episode)
    if episode.ndim != 1:
        raise ValueError(f"episode has shape {episode.shape}; expected a vector")
    _, of, length = np.unique(episode, return_inverse=True, return_counts=True)
    return len(episode) / (max(len(length), 1) * length[of])


def weighted_mse(
    pred: ArrayLike, target: ArrayLike, weight: ArrayLike
) -> tuple[float, Array]:
    """Return the weighted mean squared error and its gradient with respect to pred.

    Args:
        pred, target: (n, m).
        weight: of each row, (n,), not negative.

    Returns:
        (loss, gradient): the weighted mean over the rows of each row's mean squared
        error, divided by the sum of the weights, and 2 w (pred - target) / (m sum w),
        (n, m). Complex numbers in `pred` pass through.

    Raises:
        ValueError: shapes that do not match, or weights that are negative or all 0.
    """
    pred, target = np.asarray(pred), np.asarray(target)
    weight = checks.not_negative(weight, "weight")
    if pred.ndim != 2 or pred.shape != target.shape or weight.shape != pred.shape[:1]:
        raise ValueError(
            f"pred has shape {pred.shape}, target {target.shape} and weight "
            f"{weight.shape}; expected (n, m), (n, m) and (n,)"
        )
    if not weight.sum() > 0.0:
        raise ValueError("the weights are all 0, so they have no weighted mean")
    error = pred - target
    share = weight[:, None] / (weight.sum() * pred.shape[1])
    loss: Any = np.sum(share * error**2)
    loss = loss if np.iscomplexobj(loss) else float(loss)
    return loss, 2.0 * share * error


def binomial_pmf(n: int, p: float) -> Array:
    """Return the probabilities of 0, 1, ..., n successes in n trials, (n + 1,).

    Args:
        n: number of trials, 0 to 1000.
        p: probability of a success in each trial.

    Raises:
        ValueError: n not a whole number from 0 to 1000, or p outside of 0 to 1.
    """
    n, p = _count(n, "n"), _probability(p, "p")
    if n > MOST:
        raise ValueError(f"n is {n}; expected at most {MOST} trials")
    some = range(n + 1)
    return np.array([comb(n, k) * p**k * (1.0 - p) ** (n - k) for k in some])


def sign_test(first: ArrayLike, second: ArrayLike) -> float:
    """Return the p-value of the exact two-sided sign test of paired successes.

    For successes and failures this is McNemar's exact test. Only the starts on which
    the two policies differ are used: if both are equally good, each of these is a win
    of either policy with probability 1/2.

    Args:
        first, second: success of each policy on the same starts, (n,) each, True and
            False or 1 and 0.

    Returns:
        The probability of a split of these starts that is at least as uneven; 1 if
        the policies differ on no start.

    Raises:
        ValueError: two shapes, or an entry that is neither 0 nor 1.
    """
    one, two = _successes(first, "first"), _successes(second, "second")
    if one.shape != two.shape:
        raise ValueError(
            f"first has {len(one)} entries and second {len(two)}; expected the same"
        )
    win, lose = int(np.sum(one & ~two)), int(np.sum(two & ~one))
    return _sign_p(win + lose)[win]


def gap_by_luck(p: float, n: int, gap: int) -> float:
    """Return the probability that two sets of n trials differ by at least a gap.

    Args:
        p: success probability of each trial, in both sets.
        n: trials of each set.
        gap: difference of the numbers of successes, a whole number (not a rate).

    Returns:
        P(|X - Y| >= gap) for two independent binomial numbers X and Y; 1 for a gap of
        0 or below, 0 for a gap above n.

    Raises:
        ValueError: n or gap not whole, or p outside of 0 to 1.
    """
    pmf = binomial_pmf(n, p)
    if gap != int(gap):
        raise ValueError(f"gap is {gap}; expected a whole number of starts")
    k = np.arange(len(pmf))
    far = np.abs(k[:, None] - k) >= gap
    return float(np.sum(np.outer(pmf, pmf)[far]))


def paired_power(win: float, lose: float, n: int, level: float) -> float:
    """Return the power of the sign test on n starts.

    Args:
        win: probability that only the first policy succeeds on a start.
        lose: probability that only the second policy succeeds.
        n: number of starts.
        level: the test reports a difference if p <= level.

    Returns:
        The probability that `sign_test` reports a difference, in either direction.

    Raises:
        ValueError: n not whole, or probabilities that are no such.
    """
    win, lose = _probability(win, "win"), _probability(lose, "lose")
    level = float(checks.array(level, "level", ()))
    differ = _probability(win + lose, "win + lose")
    first = win / differ if differ else 0.0
    found = 0.0
    for d, of_d in enumerate(binomial_pmf(n, differ)):
        seen = np.array(_sign_p(d)) <= level
        found += of_d * np.sum(binomial_pmf(d, first)[seen])
    return float(found)


def best_of(p: float, n: int, k: int) -> float:
    """Return the expected success rate of the best of k equally good policies.

    Args:
        p: success probability of every policy.
        n: starts on which each policy is tested, 1 or more.
        k: number of policies, 1 or more.

    Returns:
        The expected largest of k independent binomial numbers, divided by n.

    Raises:
        ValueError: n or k not a whole number from 1, or p outside of 0 to 1.
    """
    n, k = _count(n, "n", 1), _count(k, "k", 1)
    below = np.cumsum(binomial_pmf(n, p))[:-1]  # P(X <= 0), ..., P(X <= n - 1)
    return float(np.sum(1.0 - np.minimum(below, 1.0) ** k) / n)


def holm(p: ArrayLike) -> NDArray[np.bool_]:
    """Return which of m differences are significant by Holm's method, (m,).

    The p-values are compared in ascending order, the i-th (from 0) with 0.05 / (m - i),
    up to the first that is larger. The probability of any false positive is then at
    most 0.05, whether or not the tests are independent.

    Args:
        p: p-values, (m,).

    Raises:
        ValueError: no vector, or a number outside of 0 to 1.
    """
    p = np.asarray(p, dtype=np.float64)
    if p.ndim != 1 or not ((p >= 0.0) & (p <= 1.0)).all():
        raise ValueError("p must be a vector of numbers between 0 and 1")
    order = np.argsort(p, kind="stable")
    passes = p[order] <= LEVEL / np.arange(len(p), 0, -1)
    found = np.zeros(len(p), dtype=bool)
    found[order] = np.logical_and.accumulate(passes)
    return found


def _sign_p(d: int) -> list[float]:
    """Return the p-value for 0, ..., d wins among d starts that differ.

    The sums are of whole numbers, so a p-value that equals the level does so exactly.
    """
    found, total = [], 0
    for k in range(d // 2 + 1):
        total += comb(d, k)
        found.append(min(1.0, 2 * total / 2**d))
    return found + found[: (d + 1) // 2][::-1]


def _rows(rows: Rows) -> Rows:
    """Return rows as arrays after checking that their shapes match."""
    seen, done, of = map(np.asarray, rows)
    same = len({seen.shape[:1], done.shape[:1], of.shape}) == 1
    if seen.ndim != 2 or done.ndim != 2 or not same:
        raise ValueError(
            f"the rows have the shapes {seen.shape}, {done.shape} and {of.shape}; "
            "expected (n, d), (n, m) and (n,)"
        )
    return seen, done, of


def _successes(value: ArrayLike, name: str) -> NDArray[np.bool_]:
    """Return successes as a vector of True and False."""
    won = np.asarray(value)
    if won.ndim != 1 or not np.isin(won, (0, 1)).all():
        raise ValueError(f"{name} must be a vector of True and False, or of 1 and 0")
    return won.astype(bool)


def _count(value: float, name: str, least: int = 0) -> int:
    """Return a whole number after checking that it is not below the least."""
    if not np.isfinite(value) or value != int(value) or value < least:
        raise ValueError(f"{name} is {value}; expected a whole number from {least}")
    return int(value)


def _probability(value: float, name: str) -> float:
    """Return a probability; a sum may exceed 1 by rounding."""
    if not -1e-12 <= value <= 1.0 + 1e-12:  # refuses NaN as well
        raise ValueError(f"{name} is {value}; expected a number between 0 and 1")
    return float(min(max(value, 0.0), 1.0))
