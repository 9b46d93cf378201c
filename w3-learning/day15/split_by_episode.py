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
    for n, episodes, k in ((12, 4, 2), (20, 6, 1), (15, 3, 2), (30, 8, 4), (9, 9, 3)):
        yield rng.integers(0, episodes, n), rng.permutation(episodes)[:k]


@row.spans
def _(rng):
    yield np.array([57, 57, 58, 59, 59]), np.array([40, 59])


@row.wrongs
def _(episode, held_out):
    """rows-for-episodes: the numbers in held_out are used as indices of rows. They are
      numbers of episodes: hold out every row whose entry in episode is one of them
    as-many-rows: the last rows are held out, as many as held_out has entries. Rows of
      one episode then are in both parts
    """
    rows = np.arange(len(episode))
    return {
        "rows-for-episodes": np.isin(rows, held_out),
        "as-many-rows": rows >= len(episode) - len(held_out),
    }


@row.right  # Row by row, as a list.
def _(episode, held_out):
    kept = set(held_out.tolist())
    return np.array([int(one) in kept for one in episode])


@row.right  # Each row compared with each number.
def _(episode, held_out):
    return (episode[:, None] == held_out).any(axis=1)
