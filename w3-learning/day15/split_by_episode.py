"""15.2 `split_by_episode(episode, held_out)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Mask, Row

row = Row(Mask((None,)))


@row.inputs
def _(rng):
    yield np.array([4, 4, 0, 0, 2]), np.array([2, 4])
    yield np.array([0, 0, 1, 1, 2, 2]), np.array([1])
    yield np.array([3, 3, 5]), np.array([9])  # an episode without rows
    yield np.array([7, 7, 7]), np.array([7])
    yield np.array([1, 1, 2, 2, 2, 3, 5]), np.array([3, 1])  # 2 is between them
    for n, episodes, k in ((12, 4, 2), (20, 6, 1), (15, 3, 2), (30, 8, 4), (9, 9, 3)):
        yield rng.integers(0, episodes, n), rng.permutation(episodes)[:k]


@row.spans
def _(rng):
    yield np.array([57, 57, 58, 59, 59]), np.array([40, 59])


@row.wrongs(
    hidden={
        "sixty-rows": "each episode of the lab has 60 rows",
        "as-a-range": "the lab holds out episodes 40 to 59",
        "positions": "the lab counts its episodes from 0",
    }
)
def _(episode, held_out):
    """rows-for-episodes: your code uses the entries of `held_out` as row indices. These
      entries are episode numbers, so hold out each row whose entry in `episode` is in
      `held_out`
    as-many-rows: your code holds out the last `len(held_out)` rows, which can split an
      episode. Hold out all rows of each held-out episode instead
    sixty-rows: your code assumes that each episode has 60 rows. Use the numbers in
      `episode` instead, because an episode need not have 60 rows
    training-rows: your function returns True for the training rows. Return True for the
      held-out rows instead
    swapped: your result has one entry per held-out episode, as `np.isin` with swapped
      arguments returns. Return one entry per row
    indices: your code returns the indices of the held-out rows. Return a mask instead,
      with True or False for every row
    as-a-range: your code holds out all episodes from the smallest to the largest number
      in `held_out`. Hold out only the episodes whose numbers are in `held_out`
    positions: your code renumbers the episodes as 0, 1, 2, ... in ascending order and
      compares the new numbers with `held_out`. Compare the original numbers in
      `episode` instead
    """
    rows = np.arange(len(episode))
    return {
        "rows-for-episodes": np.isin(rows, held_out),
        "as-many-rows": rows >= len(episode) - len(held_out),
        "sixty-rows": np.isin(rows // 60, held_out),
        "training-rows": ~np.isin(episode, held_out),
        "swapped": np.isin(held_out, episode),
        "indices": np.flatnonzero(np.isin(episode, held_out)),
        "as-a-range": (episode >= held_out.min()) & (episode <= held_out.max()),
        "positions": np.isin(np.unique(episode, return_inverse=True)[1], held_out),
    }


@row.right  # Row by row, as a list.
def _(episode, held_out):
    kept = set(held_out.tolist())
    return np.array([int(one) in kept for one in episode])


@row.right  # Each row compared with each number.
def _(episode, held_out):
    return (episode[:, None] == held_out).any(axis=1)
