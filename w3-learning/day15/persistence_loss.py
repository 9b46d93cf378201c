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
            "Your function stops because `np.diff(action)` takes the differences of "
            "adjacent columns. Use `axis=0` to take the differences of adjacent rows.",
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
    """across-episodes: your code includes the change from the last row of an episode to
      the first row of the next episode. Omit this change, because the policy repeats an
      action only within an episode
    start-from-0: your code includes the first row of each episode and uses 0 as the
      previous action of this row. Omit the row, because it has no previous action
    counted-as-0: your code divides the sum of the squared changes by the number of all
      pairs of adjacent rows. Exclude the pairs of rows from two episodes from this
      number too
    summed-over-columns: your code sums the squared changes over the columns. Take the
      mean over the columns instead, as `mse` does
    mean-of-means: your code computes the mean squared change of each episode and then
      averages these means. Take one mean over all squared changes instead, so that each
      change has the same weight
    mean-of-means 2: your code computes the mean squared change of each episode and then
      averages these means. Take one mean over all squared changes instead, so that each
      change has the same weight
    mean-action: your result is the loss of a policy that always returns the mean
      action. Use the action of the previous row as the prediction instead
    divided-by-all: your code divides the sum of the squared changes by the number of
      entries in `action`. An episode with n rows has only n - 1 changes, so divide by
      the number of squared changes
    across-columns: your code takes the differences between columns. Take the
      differences between rows (axis 0) instead
    by-number: your code treats all rows with the same episode number as one episode. A
      later episode can have the same number, so use only pairs of rows that are
      adjacent in `action`
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
