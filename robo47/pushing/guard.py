"""The guard: how far what is observed lies from the demonstrations, and an alarm.

The score of an observation is the distance to the nearest demonstrated one, both
normalised, so its unit is a standard deviation. The limit comes from runs of the policy
in the plane (Day 21), in which the puck is moved aside once as well: its data must be
exchangeable with the runs that it guards.
"""

from typing import Any

import numpy as np

from robo47 import chunking, push
from robo47.checks import Array
from robo47.pushing import learning

EPISODES = 60  # runs of the policy in the plane
FALSE_ALARMS = 0.02  # the largest probability that a usual run exceeds the limit
IN_A_ROW = 3  # ticks above the limit before it raises the alarm
TICKS, BEFORE = 100, 30  # of such a run, and those before the puck is moved
MOVED = 0.06  # m
EVERY = 4  # one demonstrated observation in four is compared
SEED = 500  # of the starts of these runs, and of their draws


class Guard:
    """The scores of a run so far, and the limit."""

    def __init__(self, fns: Any, limit: float):
        """Begin without a score.

        Args:
            fns: has `normalise`, `nearest_distance` and `alarm_at`, and trains.
            limit: of a score.
        """
        self.fns = fns
        self.limit = limit
        self.scores: list[float] = []

    def alarm(self, seen: Array) -> bool:
        """Take an observation, (4,); return whether it is time to stop."""
        score = novelty(self.fns, seen[None])[0]
        self.scores.append(float(score))
        at = self.fns.alarm_at(np.array(self.scores), self.limit, IN_A_ROW)
        return int(at) >= 0


def novelty(fns: Any, seen: Array) -> Array:
    """Return the distance of observations (n, 4) to the demonstrated ones, (n,)."""
    data = learning.policy(fns).data
    z = fns.normalise(seen, data.scalers[0])
    return np.asarray(fns.nearest_distance(data.seen[::EVERY], z))


def guard_scores(fns: Any, n: int = EPISODES, seed: int = SEED) -> Array:
    """Return the largest novelty of each of n runs of the policy in the plane, (n,).

    Args:
        fns: has the functions of the push, by name.
        n: number of runs.
        seed: of their starts and draws.
    """
    rng = np.random.default_rng(seed)
    start = push.dock(n, rng)
    side = rng.choice([-1.0, 1.0], n)
    drawn = learning.policy(fns)

    def plan(seen: Array) -> Array:
        return drawn.draw(seen, rng.normal(size=(n, 2 * learning.ACTIONS)))

    def run(start: Array, ticks: int) -> Array:
        acting = chunking.chunked_policy(plan, learning.EXECUTED)
        return push.run(*push.scene(), start, acting, ticks).observation

    before = run(start, BEFORE)
    after = run(moved_aside(before[:, -1], side), TICKS - BEFORE)
    seen = np.concatenate([before, after], axis=1)
    return np.max([novelty(fns, now) for now in seen.transpose(1, 0, 2)], axis=0)


def moved_aside(seen: Array, side: Array) -> Array:
    """Return observations, (n, 4), after the puck was moved across its way home.

    Args:
        seen: observations, (n, 4).
        side: of each, (n,), 1 or -1.
    """
    x, y = seen[:, 2:].T
    across = np.column_stack([-y, x]) / np.maximum(np.hypot(x, y), 1e-9)[:, None]
    moved = seen.copy()
    moved[:, 2:] += MOVED * side[:, None] * across
    return moved


def limit(fns: Any) -> float:
    """Return the limit of the guard: the conformal one of runs in the plane."""
    return float(fns.conformal_limit(guard_scores(fns), FALSE_ALARMS))
