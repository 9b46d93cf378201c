"""18.2 `aggregate(first, second)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Matrix, Row, Vector

row = Row((
    Matrix((None, None), called="the array of observations"),
    Matrix((None, None), called="the array of actions"),
    Vector((None,), called="the vector of episode numbers"),
))  # fmt: skip


def rows(rng, episode, d=2, m=1):
    """Return rows of these episodes: observations, actions, numbers."""
    n = len(episode)
    return rng.numbers(-1, 1, n, d), rng.numbers(-1, 1, n, m), np.array(episode)


@row.inputs
def _(rng):
    yield rows(rng, [0, 3]), rows(rng, [0, 1])
    yield rows(rng, [0]), rows(rng, [0])
    yield rows(rng, [2, 2, 0, 0, 0], 3, 2), rows(rng, [0, 0], 3, 2)  # not in order
    yield rows(rng, [4, 4, 1]), rows(rng, [0, 1, 1, 2])
    yield rows(rng, [0, 0, 1, 1]), rows(rng, [1, 0])
    yield rows(rng, [1, 0]), rows(rng, [0, 2, 4, 4])  # more episodes than the first
    for _ in range(5):
        one = rng.permutation(rng.integers(2, 9, int(rng.integers(2, 6))))
        other = np.sort(rng.integers(0, 3, int(rng.integers(1, 5))))
        d, m = rng.integers(1, 4, 2)
        yield rows(rng, one, d, m), rows(rng, other - other.min(), d, m)


@row.wrongs
def _(first, second):
    """numbers-collide: your code keeps the episode numbers of the second data set, so
      two episodes can have the same number. Shift the numbers of the second set by the
      largest number in the first set plus 1
    shift-by-last: your code shifts the episode numbers by the last number in the first
      data set plus 1. Use the largest number in this set plus 1 instead, because the
      numbers can be in any order
    shared-number: your code shifts the episode numbers by the largest number in the
      first data set. Shift by this number plus 1, because the episodes of the second
      set begin at 0
    largest-of-both: your code shifts the episode numbers by the largest number in both
      data sets plus 1. Use only the largest number in the first set, as the task
      specifies
    first-shifted: your code shifts the episode numbers of the first data set. Keep the
      numbers of the first set, and shift the numbers of the second set instead
    per-row: your code assigns a new episode number to each row of the second data set.
      All rows of an episode need the same number, so add the same shift to all numbers
    counted: your code shifts the episode numbers by the number of episodes in the first
      data set. Use the largest number in this set plus 1, because some numbers can be
      missing
    counted-rows: your code shifts the episode numbers by the number of rows in the
      first data set. Use the largest episode number in this set plus 1 instead
    new-only: your function omits the rows of the first data set. Return these rows,
      followed by the rows of the second data set
    second-first: your code puts the rows of the second data set before the rows of the
      first. Reverse this order
    renumbered: your code renumbers the episodes of both data sets from 0. Keep the
      episode numbers of the first data set, and shift only the numbers of the second
    without-gaps: your code renumbers the episodes of the second data set without gaps.
      Add the same shift to all episode numbers of this set instead
    without-gaps 2: your code renumbers the episodes of the second data set without
      gaps, in their order of appearance. Add the same shift to all episode numbers of
      this set instead
    sorted-rows: your code sorts all rows by episode number. Keep the rows of each data
      set in their original order
    sorted-numbers: your code sorts the episode numbers, but not the observations and
      actions. Keep the episode numbers in the order of their rows
    """
    of, of_2 = first[2], second[2]
    seen, done = (np.vstack([first[i], second[i]]) for i in (0, 1))
    shifts = {
        "numbers-collide": 0,
        "shift-by-last": of[-1] + 1,
        "shared-number": of.max(),
        "largest-of-both": max(of.max(), of_2.max()) + 1,
        "counted": len(np.unique(of)),
        "counted-rows": len(of),
    }
    new = of_2 + of.max() + 1
    every = np.append(of, new)
    order = np.argsort(every, kind="stable")
    _, begins, which = np.unique(of_2, return_index=True, return_inverse=True)
    places = np.argsort(np.argsort(begins))[which]
    return {
        **{slug: (seen, done, np.append(of, of_2 + s)) for slug, s in shifts.items()},
        "first-shifted": (seen, done, np.append(of + of_2.max() + 1, of_2)),
        "per-row": (seen, done, np.append(of, of.max() + 1 + np.arange(len(of_2)))),
        "new-only": (second[0], second[1], new),
        "second-first": (
            np.vstack([second[0], first[0]]),
            np.vstack([second[1], first[1]]),
            np.append(new, of),
        ),
        "renumbered": (seen, done, np.unique(every, return_inverse=True)[1]),
        "without-gaps": (seen, done, np.append(of, of.max() + 1 + which)),
        "without-gaps 2": (seen, done, np.append(of, of.max() + 1 + places)),
        "sorted-rows": (seen[order], done[order], every[order]),
        "sorted-numbers": (seen, done, every[order]),
    }


@row.right  # A loop over the rows of the second.
def _(first, second):
    seen, done, of = (list(one) for one in first)
    free = max(of) + 1
    for x, action, number in zip(*second, strict=True):
        seen.append(x)
        done.append(action)
        of.append(free + number)
    return np.array(seen), np.array(done), np.array(of)


@row.right  # All three at once.
def _(first, second):
    x, y, z = second
    z = z + 1 + np.max(first[2])
    return tuple(np.concatenate(pair) for pair in zip(first, (x, y, z), strict=True))
