"""17.6 `timesteps(T, n)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Vector

row = Row(Vector((None,), called="the levels"))


@row.inputs
def _(rng):
    # None of these has a level halfway between two whole numbers.
    yield from ((50, 10), (10, 4), (7, 1), (1, 1), (9, 9), (100, 8), (9, 3))
    yield from ((12, 2), (8, 6), (100, 100), (23, 6))
    n, apart = rng.integers(2, 7, 2)
    yield int(1 + (n - 1) * apart), int(n)


row.cases(
    one_step=lambda T, n: n == 1,
    all_levels=lambda T, n: n == T > 1,
    some_of_the_levels=lambda T, n: 1 < n < T,
)


row.at_least_0(T="a number of levels", n="a number of steps", answer="levels")


@row.wrongs
def _(T, n):
    """leading: your code uses multiples of T // n as levels, so the noisiest level, T -
      1, can be missing. Use n equally spaced numbers from T - 1 to 0, and round them
    trailing: your code decreases the level in steps of T / n, so the last level is not
      always 0. Use n equally spaced numbers from T - 1 to 0, and round them
    whole-steps: your code decreases the level in steps of T // n, so the number of
      levels is not always n. Use n equally spaced numbers from T - 1 to 0, and round
      them
    whole-steps 2: your code rounds down the spacing between levels, so the last level
      is not always 0. Use n equally spaced numbers from T - 1 to 0, and round them
    endpoint-missing: your code decreases the level in steps of (T - 1) / n, so the last
      level is not 0. Divide T - 1 by n - 1 instead, because n levels have n - 1
      intervals between them
    ascending: your function returns the levels in ascending order. Return the levels in
      descending order, because a sampler starts at the noisiest level, T - 1
    one-step-at-0: your function returns level 0 for n = 1. Return T - 1 instead,
      because a sampler always starts at the noisiest level
    rounded-down: your code rounds the levels down. Round the levels to the nearest
      whole number instead
    rounded-up: your code rounds the levels up. Round the levels to the nearest whole
      number instead
    not-rounded: your function does not round the levels. Round the levels to the
      nearest whole number, because the sampler uses the levels as indices into the
      schedule
    """
    even = np.linspace(T - 1, 0, n)
    return {
        "leading": (np.arange(n) * (T // n))[::-1],
        "trailing": np.round(np.arange(T, 0, -T / n))[:n] - 1,
        "whole-steps": np.arange(T - 1, -1, -(T // n)),
        "whole-steps 2": T - 1 - np.arange(n) * ((T - 1) // max(n - 1, 1)),
        "endpoint-missing": np.rint(np.linspace(T - 1, 0, n, endpoint=False)),
        "one-step-at-0": np.rint(even) if n > 1 else np.zeros(1),
        "rounded-down": np.floor(even),
        "rounded-up": np.ceil(even),
        "ascending": np.rint(even[::-1] if n > 1 else even),
        "not-rounded": even,
    }


@row.right  # One by one.
def _(T, n):
    return np.array([round((T - 1) * (1 - i / max(n - 1, 1))) for i in range(n)])


@row.right  # From the last to the first.
def _(T, n):
    if n == 1:
        return np.array([T - 1])
    return np.floor(np.linspace(0, T - 1, n) + 0.5).astype(int)[::-1]


@row.spans
def _(rng):
    yield 100, 20


row.same(
    "return (np.rint(np.linspace(T - 1, 0, n)).astype(int)).astype(np.float32)",
    "whole numbers",
)
