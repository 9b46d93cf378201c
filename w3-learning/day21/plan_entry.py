"""21.3 `plan_entry(plan, drawn, now)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Vector

row = Row(Vector((None,), "m/s"), copies=False)


@row.inputs
def _(rng):
    yield np.arange(1.0, 6)[:, None], 12, 15
    for K, m, drawn, late in (
        (8, 2, 0, 0),
        (8, 2, 4, 3),
        (8, 2, 20, 7),  # the last row
        (8, 2, 20, 8),  # run out
        (3, 1, 5, 9),
        (1, 2, 2, 0),
        (1, 2, 2, 1),
        (4, 3, 0, 2),
        (5, 2, 3, 11),
    ):
        yield rng.numbers(-1, 1, K, m), drawn, drawn + late
    for _ in range(3):
        drawn = int(rng.integers(0, 60))
        yield rng.numbers(-1, 1, 8, 2), drawn, drawn + int(rng.integers(0, 12))


def late(plan, drawn, now):
    """Return how many ticks ago the plan was drawn."""
    return now - drawn


row.cases(
    plans_that_are_not_late=lambda plan, drawn, now: now == drawn,
    plans_that_are_late=lambda plan, drawn, now: 0 < now - drawn < len(plan),
    plans_that_have_run_out=lambda plan, drawn, now: now - drawn >= len(plan),
)


@row.rare
def _(rng):
    drawn = int(rng.integers(0, 60))
    for some in (0, 1, 4):
        yield rng.numbers(-1, 1, 3, 2), drawn, drawn + some


@row.wrongs
def _(plan, drawn, now):
    """from-the-start: your function always returns the first row, which is the action
      for the tick `drawn`. Return row `now - drawn` instead
    wraps: your code starts again at the first row if the plan has run out. Return the
      last row instead
    one-late: your code treats the first row as the action for the tick `drawn + 1`.
      Return row `now - drawn`, because the first row is the action for the tick `drawn`
    stops: your function returns 0 if the plan has run out. Return the last row instead
    first-at-the-end: your function returns the first row if the plan has run out.
      Return the last row instead
    column: your function returns a column of the plan. Return a row instead, because
      each row is the action of one tick
    all-that-is-left: your function returns all rows from the current tick on. Return
      only the row for the current tick
    mean-so-far: your function returns the mean of the rows up to the current tick.
      Return only row `now - drawn`, because each row is the action of one tick
    last-always: your function returns the last row for every plan that is late. Return
      row `now - drawn` instead, and the last row only if the plan has run out
    """
    i, K = now - drawn, len(plan)
    return {
        "from-the-start": plan[0],
        "wraps": plan[i % K],
        "one-late": plan[min(max(i - 1, 0), K - 1)],
        "stops": plan[i] if i < K else 0 * plan[0],
        "first-at-the-end": plan[i] if i < K else plan[0],
        "column": plan[:, min(i, plan.shape[1] - 1)],
        "all-that-is-left": plan[min(i, K - 1) :],
        "mean-so-far": np.mean(plan[: i + 1], axis=0),
        "last-always": plan[0 if i == 0 else -1],
    }


@row.right  # By the rows that are left.
def _(plan, drawn, now):
    left = plan[now - drawn :]
    return left[0] if len(left) else plan[-1]


@row.right  # By clamping.
def _(plan, drawn, now):
    return plan[np.clip(now - drawn, 0, plan.shape[0] - 1)]


@row.spans
def _(rng):
    yield rng.numbers(-1, 1, 40, 2), 1000, 1020
    yield rng.numbers(-1, 1, 8, 20), 3, 1000
    yield 1e-3 * rng.numbers(-1, 1, 8, 2), 4, 7


row.at_least_0(drawn="a tick", now="a tick")
