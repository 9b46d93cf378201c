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
    """majority: your result is 1 where more than half of the chunks have started, the
      median. The task asks for the fraction
    wait-not-plus-1: your fraction is divided by the steps of the pause. A pause of w
      steps has w + 1 rows with the same observation
    not-clamped: your fractions exceed 1. After the longest wait all chunks have
      started
    one-jump: your result is 0 before the entry `wait` and 1 from there on, as in the
      chunk of the first row. Average over the rows of the pause
    one-entry-late: your result is j / (w + 1). By entry 0 the chunk of the row that
      moves has started already
    moving-row-omitted: your mean is over the w rows of the pause. The first row in
      which the demonstrator moves has the same observation, so w + 1 rows belong to it
    moving-row-omitted 2: your mean is over the w rows of the pause. The first row in
      which the demonstrator moves has the same observation, so w + 1 rows belong to it
    one-entry-early: your result is (j + 2) / (w + 1). By entry 0 only the chunk of one
      row has started
    independent-starts: your result holds if the motion starts in each step with the
      probability 1 / (w + 1). The pause has a fixed number of steps: count its rows
    all-started: your result is 1 everywhere. In the pause, the motion has started by
      entry j only in the rows in which at most j steps remain
    still-waiting: your result is the fraction that still waits. Subtract it from 1
    stretched: your fractions rise evenly until the last entry. The longest wait ends at
      the entry `wait`, for any K
    stretched 2: your fractions rise evenly until the last entry. The longest wait ends
      at the entry `wait`, for any K
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
