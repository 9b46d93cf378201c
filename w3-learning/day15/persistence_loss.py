"""15.8 `persistence_loss(action, episode)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Scalar

row = Row(Scalar())


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


@row.wrongs(hidden={"by-number": "each number of the lab occurs once"})
def _(action, episode):
    """across-episodes: the change from the last row of an episode to the first row of
      the next one is included. Nobody repeats an action of another episode: leave these
      pairs out
    start-from-0: the first row of each episode is included, with a last action of 0.
      This row has no last action: leave it out
    counted-as-0: the pairs across two episodes are counted as changes of 0. Leave them
      out of the mean
    summed-over-columns: the squares are summed over the columns. Take the mean over the
      columns, as `mse` does
    by-number: all rows with the same number are joined, but the number comes again in a
      later episode. Only adjacent rows are pairs
    """
    change = action[1:] - action[:-1]
    same = episode[1:] == episode[:-1]
    last = np.vstack([0 * action[:1], action[:-1] * same[:, None]])
    joined = [np.diff(action[episode == one], axis=0) for one in np.unique(episode)]
    return {
        "across-episodes": np.mean(change**2),
        "start-from-0": np.mean((action - last) ** 2),
        "counted-as-0": np.mean(change**2 * same[:, None]),
        "summed-over-columns": np.sum(change[same] ** 2) / same.sum(),
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
