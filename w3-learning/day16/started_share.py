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
    no_pause=lambda wait, K: wait == 0,
    a_pause=lambda wait, K: wait > 0,
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
    """
    j = np.arange(K)
    right = np.minimum(1, (j + 1) / (wait + 1))
    return {
        "majority": 1.0 * (right > 0.5),
        "wait-not-plus-1": np.minimum(1, (j + 1) / max(wait, 1)),
        "not-clamped": (j + 1) / (wait + 1),
        "one-jump": 1.0 * (j >= wait),
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
