"""Inverse kinematics of one arm for many targets at once, in pure NumPy.

Every target has walkers, configurations that go downhill as `walk` says. A target that
none of its walkers reaches gets new ones, the nearest of some random configurations,
and the fewer targets are left, the more walkers each has: the arrays stay wide, which
is what NumPy is fast at. A few targets are walked to one by one first, in the plain
floats of `ik_one`.

All arrays here are columns: q (joints, n), goals (3, 4, n). Units: metres, radians.
"""

import functools
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from robo47 import checks
from robo47.checks import Array
from robo47.fast.chains import Plan, plan_of
from robo47.fast.ik_many import Many
from robo47.fast.ik_one import One
from robo47.fast.jacobians import jacobian_columns
from robo47.fast.walk import STOP, Patience, walk
from robo47.rotation_log import pose_error
from robo47.screws import fk_space

REACHED = 1e-8  # the norm of the pose error (radians and metres) of a solution
# Targets at once. Their table of distances to DRAWN poses is the largest array, 8 MB.
# A chunk of 4,096 would take 33 MB, for a third less time (measured).
CHUNK = 1024
# Walkers at once while targets are left, at least: with one for each, 2 of 1,024 random
# targets stay unreached after all rounds (measured).
WIDTH = 500
MOST = 50  # walkers of one target
# Random configurations that the nearest ones are chosen from: with 160 a target alone
# takes 8 % more steps, with 4,000 11 % fewer (measured), but all are compared.
DRAWN = 1000
ROUNDS = 20
# Targets that are walked to one by one. 4 of them so take a third of the time that they
# take together, 16 as long, 32 twice as long (measured).
FEW = 16
# Starts of each of those before they go on together: with 2 it takes half as many steps
# again, since a round together walks from up to MOST starts (measured).
TRIES = 16
# Patient from the caller's start, impatient from a random one; with less damping a
# walker takes fewer steps, but ends farther from a target that is out of reach.
FIRST = Patience(60, 5, 0.9, 0.5)
AGAIN = Patience(30, 3, 0.5, 0.5)
BOLD = AGAIN._replace(damping=0.1)


class _Problem(NamedTuple):
    plan: Plan
    goals: Array
    low: Array
    high: Array


def solve_ik(
    screws: ArrayLike,
    M_home: ArrayLike,
    T_goal: ArrayLike,
    q_start: ArrayLike,
    limits: ArrayLike,
) -> Array:
    """Return joint angles that bring the end effector to each target.

    This is inverse kinematics by damped least squares. The first trial starts at
    q_start and later trials at seeded random configurations, so the same call returns
    the same result. `reached` returns which targets were reached. A start that is at
    its target is returned unchanged.

    Args:
        screws: space screws (omega; v) of one arm, (n, 6).
        M_home: `T_world_ee` at q = 0, (4, 4).
        T_goal: targets, `T_world_ee`, (..., 4, 4).
        q_start: start, radians (metres for slides), (..., n), which is clamped to the
            limits first.
        limits: lower and upper limit of each joint, (n, 2).

    Returns:
        q, (..., n), always within the limits. For a target that no trial reaches, such
        as one out of reach, the q with the smallest norm of `pose_error`.

    Raises:
        ValueError: wrong shape, a non-finite number, no screw, not a pose, or a lower
            limit above its upper one.
    """
    S, M_home, T, q, low, high = _checked(screws, M_home, T_goal, q_start, limits)
    lead = np.broadcast_shapes(T.shape[:-2], q.shape[:-1])
    T = np.broadcast_to(T, (*lead, 4, 4)).reshape(-1, 4, 4)
    q = np.broadcast_to(q, (*lead, len(S))).reshape(-1, len(S))
    plan = plan_of(S, M_home)
    out = np.empty_like(q)
    for first in range(0, len(q), CHUNK):
        part = slice(first, first + CHUNK)
        goals = np.ascontiguousarray(np.moveaxis(T[part, :3], 0, -1))
        start = np.clip(q[part].T, low, high)
        out[part] = _solve(_Problem(plan, goals, low, high), start).T
    return out.reshape(*lead, len(S))


def reached(
    screws: ArrayLike, M_home: ArrayLike, T_goal: ArrayLike, q: ArrayLike
) -> np.ndarray:
    """Return whether q brings the end effector to its target, to 1e-8.

    Args:
        screws, M_home, T_goal: as in `solve_ik`.
        q: what `solve_ik` returned, (..., n).

    Returns:
        True where the norm of the pose error (radians, metres) is below 1e-8, (...).

    Raises:
        ValueError: as `solve_ik`.
    """
    e = pose_error(fk_space(screws, M_home, q), T_goal)
    return np.linalg.norm(e, axis=-1) < REACHED


def _solve(problem: _Problem, start: Array) -> Array:
    """Return the best q found for every target, (joints, n)."""
    rng = np.random.default_rng(47)
    around = (problem.plan, problem.low, problem.high)
    everyone = np.arange(start.shape[1])
    if start.shape[1] <= FEW:
        best, miss = _one_by_one(problem, start)
    else:
        best, miss = _walked(problem, start, everyone, FIRST)
    for _ in range(ROUNDS):
        left = np.flatnonzero(miss > STOP**2)
        if not len(left):
            break
        each = int(np.clip(WIDTH // len(left), 1, MOST))
        target = np.repeat(left, each)
        drawn = _drawn(*around, each * max(DRAWN // each, 20), rng)
        q, ee = _walked(problem, _nearest(problem, left, each, *drawn), target, AGAIN)
        pick = ee.reshape(-1, each).argmin(axis=1) + each * np.arange(len(left))
        better = ee[pick] < miss[left]
        best[:, left[better]] = q[:, pick[better]]
        miss[left[better]] = ee[pick[better]]
    return best


def _one_by_one(problem: _Problem, start: Array) -> tuple[Array, Array]:
    """Return the best q of each target, (joints, n), and its squared error, (n,)."""
    plan, goals, low, high = problem
    limits = np.hstack([low, high])
    best = start.copy()
    miss = np.empty(start.shape[1])
    for i in range(len(miss)):
        one = One(plan, goals[..., i], limits)
        one.begin(start[:, i].tolist())
        walk(one, FIRST)
        best[:, i] = one.best
        miss[i] = one.miss
        if miss[i] <= STOP**2:
            continue
        drawn = _pool(plan, low.tobytes(), high.tobytes())
        for q in _nearest(problem, np.array([i]), TRIES, *drawn).T.tolist():
            one.begin(q)
            walk(one, BOLD)
            if one.miss < miss[i]:
                best[:, i] = one.best
                miss[i] = one.miss
            if one.miss <= STOP**2:
                break
    return best, miss


def _walked(
    problem: _Problem, q: Array, target: np.ndarray, patience: Patience
) -> tuple[Array, Array]:
    """Return every walker's best q, (joints, n), and its squared error, (n,)."""
    plan, goals, low, high = problem
    many = Many(plan, goals, np.stack([low, high]), q, target)
    walk(many, patience)
    return many.best, many.miss


@functools.lru_cache(maxsize=16)
def _pool(plan: Plan, low: bytes, high: bytes) -> tuple[Array, Array]:
    """Return random configurations of one arm, drawn once, with their poses."""
    lowest = np.frombuffer(low)[:, None]
    highest = np.frombuffer(high)[:, None]
    n = DRAWN // TRIES * TRIES
    return _drawn(plan, lowest, highest, n, np.random.default_rng(48))


def _drawn(
    plan: Plan, low: Array, high: Array, n: int, rng: np.random.Generator
) -> tuple[Array, Array]:
    """Return random configurations, (joints, n), and their weighted poses, (12, n)."""
    q = rng.uniform(low, high, (len(low), n))
    _, end = jacobian_columns(plan, q, at_end=True)
    return q, _weighted(end)


def _weighted(T: Array) -> Array:
    return np.concatenate([np.sqrt(0.5) * T[:, :3].reshape(9, -1), T[:, 3]])


def _nearest(
    problem: _Problem, left: np.ndarray, each: int, q: Array, drawn: Array
) -> Array:
    """Return of each of so many groups of configurations the one of the nearest pose.

    Nearest: |p - p'|^2 plus half of |R - R'|^2, which is about the squared angle.
    """
    goals = problem.goals[..., left]
    wanted = _weighted(goals)
    apart = (drawn * drawn).sum(axis=0) - 2.0 * (wanted.T @ drawn)
    apart = apart.reshape(len(left), each, -1)
    group = apart.shape[-1]
    return q[:, (apart.argmin(axis=-1) + group * np.arange(each)).ravel()]


def _checked(
    S: ArrayLike, M_home: ArrayLike, T: ArrayLike, q: ArrayLike, limits: ArrayLike
) -> tuple[Array, ...]:
    S = checks.screws(S, "screws")
    M_home = checks.pose(M_home, "M_home")
    if S.ndim != 2 or M_home.ndim != 2:
        raise ValueError(
            f"screws has shape {S.shape} and M_home {M_home.shape}; expected (n, 6) "
            "one arm, many targets"
        )
    limits = checks.array(limits, "limits", (len(S), 2))
    low, high = limits.reshape(len(S), 2).T[..., None]
    if (bad := (low > high)[:, 0]).any():
        i = int(np.argmax(bad))
        raise ValueError(f"limits[{i}] is {limits[i].tolist()}; expected low <= high")
    T = checks.pose(T, "T_goal")
    q = checks.array(q, "q_start", (len(S),))
    return S, M_home, T, q, low, high
