"""16.4 `started_share(wait, K)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Vector

row = Row(Vector((None,)))


@row.inputs
def _(rng):
    yield 1, 3
    yield from ((6, 8), (0, 3), (2, 5), (5, 2), (3, 4), (9, 12), (4, 1))
    yield int(rng.integers(0, 12)), int(rng.integers(1, 14))


row.cases(
    calls_without_a_pause=lambda wait, K: wait == 0,
    calls_with_a_pause=lambda wait, K: wait > 0,
)


@row.wrongs
def _(wait, K):
    """majority: your function returns 1 if the entry is at full speed in more than half
      of the rows, and 0 otherwise. Return the fraction of the rows in which the entry
      is at full speed
    wait-not-plus-1: your code divides j + 1 by `wait`. Divide j + 1 by wait + 1
      instead, because wait + 1 rows have the same observation
    not-clamped: your function returns fractions above 1. Limit each fraction to 1,
      because the motion has started in all rows from entry `wait` on
    one-jump: your function returns the chunk of the first row, which is 0 before entry
      `wait` and 1 from this entry on. Average the chunks of all wait + 1 rows instead
    one-entry-late: your function returns j / (wait + 1). Use j + 1 instead of j,
      because entry 0 is already at full speed in the row with 0 remaining steps
    moving-row-omitted: your function returns j / wait, limited to 1. Use (j + 1) /
      (wait + 1), because the first row in which the demonstrator moves has the same
      observation as the `wait` rows of the pause
    moving-row-omitted 2: your function returns j / wait, limited to 1. Use (j + 1) /
      (wait + 1), because the first row in which the demonstrator moves has the same
      observation as the `wait` rows of the pause
    one-entry-early: your function returns (j + 2) / (wait + 1). Use j + 1 instead of j
      + 2, because entry 0 is at full speed in one row only
    independent-starts: your code assumes that the motion starts with probability 1 /
      (wait + 1) in each step. The pause has a fixed number of steps, so count the rows
      in which at most j steps remain
    all-started: your function returns 1 for every entry. Return the fraction of the
      rows in which at most j steps remain until the motion starts
    still-waiting: your function returns the fraction of the rows in which the motion
      has not started by entry j. Subtract this fraction from 1
    stretched: your code increases the fraction linearly up to the last entry. Increase
      the fraction by 1 / (wait + 1) per entry instead, up to 1 at entry `wait`
    stretched 2: your code increases the fraction linearly up to the last entry.
      Increase the fraction by 1 / (wait + 1) per entry instead, up to 1 at entry `wait`
    """
    j = np.arange(K)
    right = np.minimum(1, (j + 1) / (wait + 1))
    return {
        "majority": 1.0 * (right > 0.5),
        "wait-not-plus-1": np.minimum(1, (j + 1) / max(wait, 1)),
        "not-clamped": (j + 1) / (wait + 1),
        "one-jump": 1.0 * (j >= wait),
        "one-entry-late": np.minimum(1, j / (wait + 1)),
        "moving-row-omitted": np.minimum(1, j / max(wait, 1)),
        "moving-row-omitted 2": np.minimum(1, j / wait) if wait else j + np.nan,
        "one-entry-early": np.minimum(1, (j + 2) / (wait + 1)),
        "independent-starts": 1 - (wait / (wait + 1)) ** (j + 1),
        "all-started": np.ones(K),
        "still-waiting": 1 - right,
        "stretched": np.linspace(1 / (wait + 1), 1, K),
        "stretched 2": (j + 1) / K,
    }


@row.right  # By counting the rows.
def _(wait, K):
    share = []
    for j in range(K):
        share.append(sum(left <= j for left in range(wait + 1)) / (wait + 1))
    return np.array(share)


@row.right  # The mean of the chunks of a pause.
def _(wait, K):
    moves = np.append(np.zeros(wait), np.ones(K + 1))
    return np.mean([moves[i : i + K] for i in range(wait + 1)], axis=0)


row.spans(wait=(0, 100), K=(1, 40))
