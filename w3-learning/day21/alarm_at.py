"""21.6 `alarm_at(score, limit, ticks)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Index, Row

row = Row(Index())


@row.inputs
def _(rng):
    yield np.array([0.1, 0.9, 0.2, 0.9, 0.9, 0.9]), 0.5, 3
    yield np.array([0.9, 0.9, 0.1, 0.9]), 0.5, 2
    yield np.array([0.9, 0.9, 0.1, 0.9]), 0.5, 3  # never
    yield np.array([0.1, 0.5, 0.5, 0.6]), 0.5, 1  # just at the limit
    yield np.array([0.7, np.nan, 0.7, 0.1, 0.2]), 0.5, 3
    yield np.array([0.1, 0.2, np.nan, np.nan]), 0.5, 2
    yield np.array([np.nan, 0.2, np.nan]), 0.5, 2  # never
    yield np.array([0.1, 3.0, 9.0]), np.inf, 1  # too few scores for a limit
    yield np.array([0.1, np.nan, np.nan, 0.3]), np.inf, 2
    yield np.array([0.1, 0.3, np.nan, np.nan]), np.inf, 1
    yield np.array([0.7]), 0.5, 1
    yield np.array([0.7]), 0.5, 2
    yield np.array([-0.9, -0.2, 0.1, -0.7, -0.2, -0.3]), -0.5, 2
    yield np.array([-0.9, np.nan, -0.7, -0.8, np.nan, -0.3]), 0.2, 2  # never
    yield np.array([0.9, 0.9, 0.1, 0.9, 0.9, 0.2, 0.9]), 0.5, 3  # never
    yield np.array([0.9, np.nan, 0.1, 0.9, 0.2, 0.9, 0.9, 0.9]), 0.5, 3
    for T in (6, 9, 12, 12, 20, 20):
        yield some(rng, T)


def some(rng, T):
    """Return scores of which two thirds are above the limit, some of them NaN."""
    score = rng.numbers(0, 1, T)
    score[rng.random(T) < 0.12] = np.nan
    return score, float(rng.numbers(0.3, 0.6)), int(rng.integers(1, 5))


row.cases(
    scores_without_NaN=lambda score, limit, ticks: not np.isnan(score).any(),
    scores_with_NaN=lambda score, limit, ticks: np.isnan(score).any(),
)


def at(above, ticks):
    """Return the first tick at which so many consecutive ticks were above, or -1."""
    count = 0
    for tick, high in enumerate(above):
        count = count + 1 if high else 0
        if count >= ticks:
            return tick
    return -1


def counted_down(above):
    """Return the counter at each tick if a tick that is not above reduces it by 1."""
    count, counts = 0, []
    for high in above:
        count = count + 1 if high else max(count - 1, 0)
        counts.append(count)
    return counts


@row.wrongs(hidden={"nan-is-infinity": "the limit of its check is 0.5"})
def _(score, limit, ticks):
    """not-in-a-row: your code counts all scores above the limit. Set the counter to 0
      at each score that is not above the limit, because only consecutive scores count
    first-above: your function returns the first tick with a score above the limit. Wait
      for `ticks` consecutive scores above the limit, so that a single noisy score does
      not trigger the alarm
    start-of-the-row: your function returns the first of the `ticks` consecutive ticks
      above the limit. Return the last of these ticks, because the alarm is raised only
      then
    nan-is-fine: your code treats NaN as not above the limit. Treat NaN as above the
      limit, so that a lost measurement raises an alarm
    nan-is-skipped: your code ignores ticks with NaN. Treat NaN as above the limit, so
      that a lost measurement raises an alarm
    at-the-limit: your code treats a score equal to the limit as above the limit. Treat
      only a larger score as above the limit
    one-more: your code waits for ticks + 1 consecutive scores above the limit. Wait for
      only `ticks` scores, and return the index of the last of these scores
    end-if-none: your function returns the number of ticks if there is no alarm. Return
      -1 instead
    zero-if-none: your function returns 0 if there is no alarm. Return -1 instead,
      because 0 is the index of the first tick
    end-of-the-row: your function returns the last tick before the score falls to the
      limit or below. Return the first tick at which `ticks` consecutive scores have
      been above the limit
    end-if-none 2: your function returns the last tick if there is no alarm. Return -1
      instead
    counts-down: your code reduces the counter by 1 at a score that is not above the
      limit. Set the counter to 0 instead, because only consecutive scores count
    any-of-them: your code raises the alarm if any of the last `ticks` scores is above
      the limit. Raise the alarm only if all of these scores are above the limit
    counted-from-1: your code counts the ticks from 1. Count from 0 instead, because the
      first tick is tick 0
    counted-from-1 2: your code counts the ticks from 1. Count from 0 instead, because
      the first tick is tick 0
    mean: your code compares the mean of the last `ticks` scores with the limit. Compare
      each of these scores with the limit instead
    nan-is-infinity: your code replaces NaN by infinity, which is not above an infinite
      limit. Treat NaN as above every limit, so that a lost measurement raises an alarm
    nan-at-once: your code raises the alarm at the first NaN. Count a NaN as one score
      above the limit instead
    last-alarm: your function returns the last tick at which an alarm is raised. Return
      the first such tick instead
    """
    above = ~(score <= limit)
    right = at(above, ticks)
    row_of = [at(above[: i + 1][-ticks:], ticks) >= 0 for i in range(len(score))]
    count = np.cumsum(above)
    kept = np.flatnonzero(~np.isnan(score))
    windows = [score[i + 1 - ticks : i + 1] for i in range(ticks - 1, len(score))]
    means = [~(np.mean(some) <= limit) for some in windows]
    ends = np.flatnonzero(row_of & np.append(~above[1:], True))
    lost = np.flatnonzero(np.isnan(score))
    first = at(above, 1)
    reduced = counted_down(above)
    soon = at(score > limit, ticks)
    skipped = at(score[kept] > limit, ticks)
    return {
        "not-in-a-row": int(np.argmax(count >= ticks)) if count[-1] >= ticks else -1,
        "first-above": first,
        "start-of-the-row": right - ticks + 1 if right >= 0 else -1,
        "nan-is-fine": at(score > limit, ticks),
        "nan-is-skipped": int(kept[skipped]) if skipped >= 0 else -1,
        "at-the-limit": at(~(score < limit), ticks),
        "one-more": at(above, ticks + 1),
        "end-if-none": right if right >= 0 else len(score),
        "end-if-none 2": right if right >= 0 else len(score) - 1,
        "counts-down": reduced.index(ticks) if ticks in reduced else -1,
        "any-of-them": max(first, ticks - 1) if first >= 0 and windows else -1,
        "zero-if-none": max(right, 0),
        "end-of-the-row": min(ends, default=-1),
        "counted-from-1": right + 1 if right >= 0 else -1,
        "counted-from-1 2": right + 1,
        "mean": means.index(True) + ticks - 1 if any(means) else -1,
        "nan-is-infinity": at(np.nan_to_num(score, nan=np.inf) > limit, ticks),
        "nan-at-once": min([*lost[:1], *([soon] if soon >= 0 else [])], default=-1),
        "last-alarm": max(np.flatnonzero(row_of), default=-1),
    }


@row.right  # By windows.
def _(score, limit, ticks):
    fine = score <= limit
    for end in range(ticks, len(score) + 1):
        if not fine[end - ticks : end].any():
            return end - 1
    return -1


@row.right  # By the last tick that was fine.
def _(score, limit, ticks):
    last = -1  # the last tick that was fine
    for tick, value in enumerate(score):
        if np.isnan(value) or value > limit:
            if tick - last >= ticks:
                return tick
        else:
            last = tick
    return -1


@row.spans
def _(rng):
    yield np.append(np.zeros(100), np.ones(12)), 0.5, 10
    yield 1e6 * rng.numbers(0, 1, 30), 2e5, 3
    yield 1e-3 * rng.numbers(0, 1, 30), 2e-4, 3


row.at_least_0(ticks="a number of ticks", answer="a tick; -1 is another line")
