"""18.3 `episode_weights(episode)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Vector

row = Row(Vector((None,)))


@row.inputs
def _(rng):
    yield (np.array([0, 0, 0, 1]),)
    yield (np.array([3, 3]),)
    yield (np.array([7, 2, 2, 7, 2]),)  # not in runs
    yield (np.array([5, 5, 1, 1]),)
    for n, episodes in ((6, 3), (9, 4), (12, 3), (7, 2), (10, 6)):
        yield (rng.integers(0, episodes, n),)


row.cases(
    episodes_of_equal_length=lambda episode: len(set(np.bincount(episode)) - {0}) == 1,
    episodes_of_different_lengths=lambda episode: (
        len(set(np.bincount(episode)) - {0}) > 1
    ),
)


@row.rare
def _(rng):
    k = int(rng.integers(1, 4))
    yield (np.repeat(rng.permutation(9)[: int(rng.integers(1, 5))], k),)


@row.wrongs
def _(episode):
    """one-over-length: your weights sum to 1 in each episode, so the mean of all
      weights is not 1. Multiply the weights by the total number of rows, and divide the
      result by the number of episodes
    sums-to-1: your weights sum to 1 over all rows. The mean of the weights should be 1,
      so multiply the weights by the number of rows
    length: your code weights each row in proportion to the length of its episode. Use
      the reciprocal of this length instead, so that each episode has the same total
      weight
    root: your weights are proportional to 1 / sqrt(length), where length is the number
      of rows in the episode. Use 1 / length instead, so that each episode has the same
      total weight
    by-runs: your code starts a new episode wherever the episode number changes. Rows
      with the same number belong to one episode, even if rows of other episodes lie
      between these rows
    equal: your code gives each row the weight 1, so a long episode has more influence
      than a short episode. Make each weight inversely proportional to the length of the
      row's episode
    per-episode: your function returns one weight per episode. Return one weight per row
      instead, and give each row the weight of its episode
    largest-number: your code uses the largest episode number plus 1 as the number of
      episodes. Count the distinct episode numbers instead, because some numbers can be
      missing
    in-order-of-numbers: your code returns the weights in ascending order of the episode
      numbers. The rows can be in any order, so assign to each row the weight of its own
      episode
    mean-over-episodes: your code scales the weights so that their mean over the
      episodes is 1. The mean over the rows should be 1, so divide the weights by their
      mean over the rows
    """
    _, of, length = np.unique(episode, return_inverse=True, return_counts=True)
    n, E = len(episode), len(length)
    runs = np.cumsum(np.append(0, np.diff(episode) != 0))
    run_length = np.bincount(runs)
    root = 1 / np.sqrt(length[of])
    once = n / (E * length)
    return {
        "one-over-length": 1 / length[of],
        "sums-to-1": 1 / (E * length[of]),
        "length": length[of] / np.mean(length[of]),
        "root": root / root.mean(),
        "by-runs": n / (len(run_length) * run_length[runs]),
        "equal": np.ones(n),
        "per-episode": once,
        "largest-number": n / ((episode.max() + 1) * length[of]),
        "in-order-of-numbers": np.repeat(once, length),
        "mean-over-episodes": (once / once.mean())[of],
    }


@row.right  # A loop over the episodes.
def _(episode):
    weight = np.zeros_like(episode, dtype=float)
    numbers = set(episode.tolist())
    for one in numbers:
        rows = episode == one
        weight[rows] = len(episode) / len(numbers) / rows.sum()
    return weight


@row.right  # Each row compared with all.
def _(episode):
    weight = 1 / (episode[:, None] == episode).sum(axis=1)
    return weight / weight.mean()


@row.spans
def _(rng):
    yield (np.repeat([29, 0, 3], [1, 180, 60]),)


row.at_least_0(episode="numbers of episodes", answer="weights")
