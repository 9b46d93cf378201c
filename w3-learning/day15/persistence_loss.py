"""15.8 `persistence_loss(action, episode)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Scalar, Slip

row = Row(
    Scalar(),
    slips=(
        Slip(
            "^IndexError: boolean index",
            r"np\.diff\(\s*action\s*\)",
            "last-axis",
            "Your function stops because np.diff(action) takes the differences of "
            "adjacent columns. With axis=0 it takes those of adjacent rows.",
        ),
    ),
)


def several(rng, sizes, m, first=0):
    """Return actions of episodes with so many rows, and their numbers."""
    episode = np.repeat(first + np.arange(len(sizes)), sizes)
    return rng.numbers(-1, 1, len(episode), m), episode


@row.inputs
def _(rng):
    yield np.array([[0.0], [1], [5], [5.5]]), np.array([0, 0, 1, 1])
    yield several(rng, (4,), 2)
    for sizes, m in (((3, 2), 1), ((2, 4, 3), 2), ((1, 5), 3), ((3, 1, 3), 2)):
        yield several(rng, sizes, m, int(rng.integers(0, 9)))
    action, _ = several(rng, (6,), 2)
    yield action, np.array([1, 1, 0, 0, 1, 1])  # a number that comes again


row.cases(
    one_episode=lambda action, episode: len(set(episode.tolist())) == 1,
    several_episodes=lambda action, episode: len(set(episode.tolist())) > 1,
)


@row.wrongs(
    hidden={
        "by-number": "each number of the lab occurs once",
        "mean-of-means": "each episode of the lab has 60 rows",
        "mean-of-means 2": "each episode of the lab has 60 rows",
    }
)
def _(action, episode):
    """across-episodes: in your code, the change from the last row of an episode to
      the first row of the next one is included. The policy repeats no action of
      another episode: leave these pairs out
    start-from-0: your first row of each episode is included, with a last action of
      0. This row has no last action: leave it out
    counted-as-0: your pairs across two episodes are counted as changes of 0. Leave
      them out of the mean
    summed-over-columns: in your code, the squares are summed over the columns. Take
      the mean over the columns, as `mse` does
    mean-of-means: your result is the mean of one mean per episode. Take one mean
      over all pairs, so that each pair has the same weight
    mean-of-means 2: your result is the mean of one mean per episode. Take one mean
      over all pairs, so that each pair has the same weight
    mean-action: your result is the loss of the mean action, which is the variance.
      Use the action of the row before as the prediction
    divided-by-all: in your code, the squares are divided by the number of all
      entries. An episode with n rows has n - 1 pairs: take the mean over the pairs
    across-columns: your difference is taken from one column to the next. A change
      is from one row to the next, along axis 0
    by-number: in your code, all rows with the same number are joined, but the
      number comes again in a later episode. Only adjacent rows are pairs
    """
    change = action[1:] - action[:-1]
    same = episode[1:] == episode[:-1]
    last = np.vstack([0 * action[:1], action[:-1] * same[:, None]])
    across = np.diff(action, axis=1)
    ends = np.flatnonzero(~same) + 1
    each = [np.diff(one, axis=0) for one in np.split(action, ends)]
    joined = [np.diff(action[episode == one], axis=0) for one in np.unique(episode)]
    return {
        "across-episodes": np.mean(change**2),
        "start-from-0": np.mean((action - last) ** 2),
        "counted-as-0": np.mean(change**2 * same[:, None]),
        "summed-over-columns": np.sum(change[same] ** 2) / same.sum(),
        "mean-of-means": np.mean([np.mean(one**2) for one in each if len(one)]),
        "mean-of-means 2": np.mean([np.mean(one**2) for one in joined if len(one)]),
        "mean-action": np.mean((action - action.mean(axis=0)) ** 2),
        "divided-by-all": np.sum(change[same] ** 2) / action.size,
        "across-columns": np.mean(across**2) if across.size else np.nan,
        "by-number": np.mean(np.vstack(joined) ** 2),
    }


@row.right  # A loop over the rows.
def _(action, episode):
    total, pairs = 0.0, 0
    for i in range(1, len(action)):
        if episode[i] == episode[i - 1]:
            total += np.mean((action[i] - action[i - 1]) ** 2)
            pairs += 1
    return total / pairs


@row.spans
def _(rng):
    action, episode = several(rng, (3, 4), 2)
    for size in (1e-3, 1e3):
        yield size * action, 53 + episode
