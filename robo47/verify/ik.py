"""Inverse kinematics that is given as a function: does it arrive, or come near?

A solver takes screws, (7, 6), home pose, (4, 4), T_goal, (4, 4), start, (7,), and joint
limits, (7, 2), and returns joint angles, (7,). `arm` is the first two.
"""

from typing import NamedTuple

import numpy as np

from robo47 import jacobian
from robo47.checks import Array
from robo47.fast.ik import REACHED
from robo47.screws import fk_space
from robo47.verify.answers import Function, each

NEAR, FAR = 0.3, 2.0  # radians from the start; metres from the base, out of reach
ENOUGH = 3  # failures, after which the rest is spared


class Ends(NamedTuple):
    """Where a solver ended.

    Attributes:
        missed: share of the near targets.
        out_of_reach: misses over the least possible ones, (4,).
        beyond: radians beyond the joint limits, at worst.
    """

    missed: float
    out_of_reach: Array
    beyond: float


def ends_of(
    solve: Function, arm: tuple[Array, Array], limits: Array, q: Array, seed: int
) -> Ends:
    """Return how a solver does on targets near its starts, and on some out of reach.

    Args:
        solve: the solver.
        arm: screws and home pose.
        limits: of the joints.
        q: configurations, (n, 7); starts are nearer to the middle of the limits.
        seed: of the targets.
    """
    rng = np.random.default_rng(seed)
    middle = limits.mean(axis=1)
    starts = middle + 0.7 * (q - middle)
    near = np.clip(starts + rng.uniform(-NEAR, NEAR, q.shape), *limits.T)
    goals = fk_space(*arm, near)
    found = each(lambda T, q: solve(*arm, T, q, limits), goals, starts)
    out = goals[:4].copy()
    out[:, :3, 3] *= FAR / np.linalg.norm(out[:, :3, 3], axis=1)[:, None]
    far = each(lambda T, q: solve(*arm, T, q, limits), out, starts[:4])
    best = jacobian.solve_ik(*arm, out, starts[:4], limits)  # hundreds of starts each
    return Ends(
        float(np.mean(miss(arm, found, goals) > REACHED)),
        miss(arm, far, out) / miss(arm, best, out),
        beyond(limits, np.vstack([found, far])),
    )


def tries(
    solve: Function,
    arm: tuple[Array, Array],
    limits: Array,
    goals: Array,
    q: Array,
    most: int,
    seed: int,
) -> Array:
    """Return at which try each target is reached, (n,); 0 is never.

    After three failures the rest is spared.

    Args:
        solve: the solver.
        arm: screws and home pose.
        limits: of the joints.
        goals: targets, (n, 4, 4).
        q: the first start, (7,); the others are random within the limits.
        most: starts of one target.
        seed: of the other starts.
    """
    rng = np.random.default_rng(seed)
    at: list[int] = []
    low, high = limits.T
    for goal in goals:
        if at.count(0) == ENOUGH:
            break
        starts = [q, *rng.uniform(low, high, (most - 1, len(q)))]
        found = (solve(*arm, goal, start, limits) for start in starts)
        ends = (miss(arm, q, goal) < REACHED for q in found)
        at.append(next((i for i, there in enumerate(ends, 1) if there), 0))
    return np.array(at)


def miss(arm: tuple[Array, Array], q: Array, goal: Array) -> Array:
    """Return the lengths of pose errors at q, (..., 7): radians and metres at once.

    Where q holds what is no number, it is infinite.
    """
    if not np.isfinite(q).all():
        return np.full(np.shape(q)[:-1], np.inf)
    return np.linalg.norm(jacobian.pose_error(fk_space(*arm, q), goal), axis=-1)


def beyond(limits: Array, q: Array) -> float:
    """Return how far q, (..., 7), is beyond the joint limits at worst, radians."""
    return float(np.maximum(limits[:, 0] - q, q - limits[:, 1]).max().clip(0.0))
