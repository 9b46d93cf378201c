"""16.1 `action_chunks(action, episode, K)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Matrix, Row
from labkit.judge.kinds import Kind

row = Row((
    Kind((None, None, None), called="the array of chunks"),
    Matrix((None, None), called="the mask"),
))  # fmt: skip


def several(rng, sizes, m, numbers=None):
    """Return actions of episodes with so many rows, and their numbers."""
    numbers = np.arange(len(sizes)) if numbers is None else np.array(numbers)
    episode = np.repeat(numbers, sizes)
    return rng.numbers(0.1, 1, len(episode), m), episode


@row.inputs
def _(rng):
    yield np.array([[1.0], [2], [3]]), np.zeros(3, int), 2
    yield *several(rng, (4,), 2), 3
    yield *several(rng, (3, 2), 1), 2
    yield *several(rng, (2, 4, 3), 2), 3
    yield *several(rng, (2, 1), 2), 5  # K exceeds every episode
    yield *several(rng, (3, 3), 3), 1
    yield *several(rng, (2, 1, 3), 2, (7, 2, 7)), 4  # a number that comes again
    yield *several(rng, (3, 2, 4), 1, (5, 3, 4)), 3  # numbers that are not sorted
    first, second = (int(n) for n in rng.integers(1, 5, 2))
    yield *several(rng, (first, second), 2), int(rng.integers(2, 5))


row.cases(
    one_episode=lambda action, episode, K: bool((episode == episode[0]).all()),
    several_episodes=lambda action, episode, K: bool((episode != episode[0]).any()),
)
row.cases(
    chunks_of_one_entry=lambda action, episode, K: K == 1,
    longer_chunks=lambda action, episode, K: K > 1,
)


def chunks(action, inside, ahead=0):
    """Return chunks and mask, where `inside(i, j)` is whether row j belongs to row i.

    Args:
        action: of each row, (n, m).
        inside: of two row numbers; its shape is the mask's.
        ahead: rows between a row and the first entry of its chunk.
    """
    n = len(action)
    mask = np.array(inside, dtype=float)
    rows = np.arange(n)[:, None] + np.arange(mask.shape[1]) + ahead
    mask = mask * (rows < n)
    return action[np.minimum(rows, n - 1)] * mask[..., None], mask


@row.wrongs(
    hidden={
        "ends-the-data 2": "the lab's last episode is as long as the others",
        "wraps 2": "the lab's last row belongs to another episode than its first",
    }
)
def _(action, episode, K):
    """crosses-episodes: your code fills the end of a chunk with actions of the next
      episode. Set these entries and their mask to 0 instead
    starts-next: your code begins chunk i with the action of row i + 1. Entry 0 of chunk
      i should be the action of row i
    wraps: your code fills the entries after the last row of the data with actions of
      the first rows. Set these entries and their mask to 0 instead
    by-number-only: your code treats all rows with the same episode number as one
      episode. A later episode can have the same number, so begin a new episode wherever
      the number changes
    mask-all-ones: your mask is 1 everywhere. The mask should be 0 for the entries after
      the end of the episode
    held: your code repeats the last action of an episode in the entries after its end.
      Set these entries to 0 instead
    wraps-within: your code fills the entries after the end of an episode with the first
      actions of this episode. Set these entries and their mask to 0 instead
    past: your code uses the action of row `i - j` as entry j of chunk i. Use the action
      of row i + j instead
    mask-swapped: your mask is inverted. The mask should be 1 for the entries that exist
      and 0 for all others
    mask-of-rows: your code sets the whole mask of an incomplete chunk to 0. Set the
      mask to 0 only for the entries after the end of the episode
    ends-the-data 2: your code fills the end of a chunk with actions of the next
      episode. Set these entries to 0. Your mask is correct
    wraps 2: your code fills the entries after the last row of the data with actions of
      the first rows. Set these entries and their mask to 0 instead
    last-row-dropped: your chunks omit the action in the last row of each episode.
      Include this action, because the row belongs to the episode
    last-row-dropped 2: your mask is 0 for the action of an episode's last row. The mask
      should be 1 for this entry, because the action exists
    only-entry-0: your code fills only entry 0 of each chunk. Fill entry j of chunk i
      with the action of row i + j if this row belongs to the same episode
    blocks: your code uses the same chunk for K successive rows. The chunk of each row
      should begin with the action of that row
    neighbours-only: your code sets an entry to 0 only if its row begins an episode. Set
      all entries after the end of the episode to 0
    only-larger: your code begins a new episode only where the episode number increases.
      Begin a new episode wherever the number changes
    """
    n = len(action)
    rows = np.arange(n)[:, None] + np.arange(K)
    known = np.minimum(rows, n - 1)
    count = np.cumsum(np.append(True, episode[1:] != episode[:-1]))
    same = (count[known] == count[:, None]) & (rows < n)
    targets, mask = chunks(action, same)
    later = np.minimum(rows + 1, n - 1)
    ends = np.searchsorted(count, count, side="right")[:, None]
    begins = np.searchsorted(count, count)[:, None]
    before = rows[:, :1] - np.arange(K)
    shorter = (count[later] == count[:, None]) & (rows + 1 < n)
    around = count[rows % n] == count[:, None]
    block = begins + (rows[:, :1] - begins) // K * K + np.arange(K)
    neighbour = episode[known] == episode[np.maximum(known - 1, 0)]
    larger = np.cumsum(np.append(True, episode[1:] > episode[:-1]))
    within = begins + (rows - begins) % (ends - begins)
    return {
        "crosses-episodes": chunks(action, rows < n),
        "starts-next": chunks(action, count[later] == count[:, None], ahead=1),
        "wraps": (action[rows % n], 1.0 + 0 * mask),
        "by-number-only": chunks(action, episode[known] == episode[:, None]),
        "mask-all-ones": (targets, 1.0 + 0 * mask),
        "held": (action[np.minimum(rows, ends - 1)], mask),
        "wraps-within": (action[within], 1.0 + 0 * mask),
        "past": (
            action[np.maximum(before, 0)] * (before >= begins)[..., None],
            1.0 * (before >= begins),
        ),
        "mask-swapped": (targets, 1 - mask),
        "mask-of-rows": (targets, mask * mask.all(axis=1, keepdims=True)),
        "ends-the-data 2": (action[known] * (rows < n)[..., None], mask),
        "wraps 2": (action[rows % n] * around[..., None], around),
        "last-row-dropped": chunks(action, shorter),
        "last-row-dropped 2": (targets, 1.0 * shorter),
        "only-entry-0": (targets * (np.arange(K) == 0)[:, None], mask),
        "blocks": (
            action[np.minimum(block, n - 1)] * (block < ends)[..., None],
            1.0 * (block < ends),
        ),
        "neighbours-only": chunks(action, neighbour | (rows == rows[:, :1])),
        "only-larger": chunks(action, larger[known] == larger[:, None]),
    }


@row.right  # A double loop, and a mask of truth values.
def _(action, episode, K):
    n, m = action.shape
    targets = np.zeros((n, K, m))
    mask = np.zeros((n, K), dtype=bool)
    for i in range(n):
        for j in range(K):
            if i + j == n or episode[i + j] != episode[i]:
                break
            targets[i, j] = action[i + j]
            mask[i, j] = True
    return targets, mask


@row.right  # Episode by episode, with padding.
def _(action, episode, K):
    targets, masks = [], []
    ends = np.flatnonzero(np.diff(episode)) + 1
    for some in np.split(action, ends):
        padded = np.vstack([some, np.zeros((K, action.shape[1]))])
        exists = np.append(np.ones(len(some)), np.zeros(K))
        for i in range(len(some)):
            targets.append(padded[i : i + K])
            masks.append(exists[i : i + K])
    return np.array(targets), np.array(masks)


@row.right  # Entry by entry, shifted.
def _(action, episode, K):
    targets = np.zeros((len(action), K, action.shape[1]))
    mask = np.zeros((len(action), K))
    alive = np.ones(len(action), dtype=bool)
    for j in range(min(K, len(action))):
        if j > 0:
            same = np.append(episode[j:] == episode[j - 1 : -1], np.zeros(j, bool))
            alive = alive & same
        rows = np.flatnonzero(alive)
        targets[rows, j] = action[rows + j]
        mask[rows, j] = 1
    return targets, mask


@row.spans
def _(rng):
    action, episode = several(rng, (14, 13), 2)
    for size in (1e-3, 1e3):
        yield size * action, episode + 98, 12
