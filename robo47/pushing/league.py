"""The league: policies of Week 3 on the same starts in the plane of `robo47.push`.

The first is the one that moves the arm. `compare_all` of Day 21 compares it with each
of the others (sign test, Holm).
"""

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from robo47 import chunking, push
from robo47.checks import Array
from robo47.pushing import learning
from robo47.pushing.learning import ACTIONS, DENOISING, EXECUTED, Policy

STARTS = 100
STARTS_SEED = 1000
DRAWS_SEED = 1
WITHIN = 0.01  # m: closer to home than this, a puck is at home

Row = tuple[Callable[[Any], Policy], int, int]  # policy, executed, steps of denoising


def _regression(absolute: bool, actions: int) -> Callable[[Any], Policy]:
    return lambda fns: learning.regression(fns, absolute, actions)


ROWS: dict[str, Row] = {
    "diffusion, 4 of 8 actions": (learning.policy, EXECUTED, DENOISING),
    "squared error, 1 action": (_regression(False, 1), 1, 0),
    "absolute error, 4 of 8": (_regression(True, ACTIONS), EXECUTED, 0),
    "absolute error, 1 of 8": (_regression(True, ACTIONS), 1, 0),
    "diffusion, 1 denoising step": (learning.policy, EXECUTED, 1),
    "diffusion, 1 of 8": (learning.policy, 1, DENOISING),
    "diffusion, 8 of 8": (learning.policy, ACTIONS, DENOISING),
}


def league(
    fns: Any, rows: Sequence[str] | None = None, ticks: int = push.STEPS
) -> tuple[list[str], NDArray[np.bool_]]:
    """Return the success of each policy on each start.

    Args:
        fns: has the functions of the push, by name.
        rows: names of ROWS; by default all.
        ticks: of 0.1 s, after which a puck is at home or not.

    Returns:
        The k names, and whether the puck is within 10 mm of home at the end, (k, n), as
        `compare_all` expects it.
    """
    names = list(ROWS if rows is None else rows)
    return names, np.array([succeeds(fns, name, ticks) for name in names])


def succeeds(fns: Any, name: str, ticks: int) -> NDArray[np.bool_]:
    """Return the success of a policy of ROWS after some ticks, (STARTS,)."""
    make, executed, steps = ROWS[name]
    drawn = make(fns)
    rng = np.random.default_rng(DRAWS_SEED)

    def plan(seen: Array) -> Array:
        noise = rng.normal(size=(len(seen), 2 * ACTIONS))
        return drawn.draw(seen, noise, steps)

    start = push.dock(STARTS, np.random.default_rng(STARTS_SEED))
    acting = chunking.chunked_policy(plan, executed)
    end = push.run(*push.scene(), start, acting, ticks).observation[:, -1, 2:]
    return np.asarray(np.linalg.norm(end, axis=1) < WITHIN)
