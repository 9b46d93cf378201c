"""What `solve_ik` is asked, and how its answers are judged: by where the hand is.

Near targets have to be reached, to 1e-8; of those out of reach, and of those that only
lead through a joint limit, an answer has to come near. Nothing may leave the limits.
"""

from functools import cache

import numpy as np

from robo47 import jacobian, panda, screws
from robo47.checks import Array
from robo47.diagnose import Finding, draw

from .mistakes import loops


@cache
def arm() -> tuple[Array, Array, Array]:
    """Return the Panda's screws, M and joint limits."""
    model = panda.load("panda_nohand")
    return panda.screws(model), panda.home_pose(model), model.jnt_range.copy()


def targets(rng):
    """Return a solved start, near targets, four out of reach, and near ones again."""
    S, M, limits = arm()
    start, goal = _near_targets(rng, 30, 0.7)
    some = np.flatnonzero(_reached(goal, start, limits))[:17]
    start, goal = start[some], goal[some]
    goal[0], start[0] = screws.fk_space(S, M, draw.READY), draw.READY
    start[1:3], goal[1:3] = _by_the_limits(rng)
    out = goal[9:13, :3, 3]
    out *= 2.0 / np.linalg.norm(out, axis=1)[:, None]
    return [(S, M, T, q, limits) for T, q in zip(goal, start, strict=True)]


def _near_targets(rng, n: int, part: float) -> tuple[Array, Array]:
    """Return starts in a part of the joints' ranges, and targets near them."""
    S, M, limits = arm()
    middle = limits.mean(axis=1)
    start = draw.rounded(middle + part * (draw.configurations(rng, n) - middle))
    near = np.clip(start + draw.numbers(rng, -0.3, 0.3, n, 7), *limits.T)
    return start, screws.fk_space(S, M, near)


def _by_the_limits(rng) -> tuple[Array, Array]:
    """Return two starts and targets that lead far beyond a limit, if none is kept."""
    _, _, limits = arm()
    start, goal = _near_targets(rng, 30, 0.99)
    q = loops.walk(*_stacked(goal, start, limits), clip=False)
    beyond = np.maximum(limits[:, 0] - q, q - limits[:, 1]).max(axis=1)
    some = np.argsort(-beyond)[:2]
    return start[some], goal[some]


def _stacked(goal: Array, start: Array, limits: Array) -> tuple[Array, ...]:
    S, M, _ = arm()
    S, M, limits = (np.broadcast_to(x, (len(goal), *x.shape)) for x in (S, M, limits))
    return S, M, goal, start, limits


def _reached(goal: Array, start: Array, limits: Array) -> np.ndarray:
    """Return whether the right loop has steps to spare for a target, (n,)."""
    S, M, _ = arm()
    q = loops.walk(*_stacked(goal, start, limits), steps=25)
    return jacobian.reached(S, M, goal, q)


def arrived(S, M, T_goal, q_start, limits, q) -> Finding | None:
    """Return what is wrong with an answer of solve_ik, or None."""
    if not np.isfinite(q).all():
        return Finding("not-finite", "It returns numbers that are not finite.")
    beyond = np.maximum(limits[:, 0] - q, q - limits[:, 1])
    if beyond.max() > 1e-12:
        i = int(np.argmax(beyond))
        says = f"joint{i + 1} is {beyond[i]:.3g} rad beyond its limit."
        return Finding("beyond-a-limit", f"It leaves the joint limits: {says}")
    before, after = _miss(S, M, T_goal, q_start), _miss(S, M, T_goal, q)
    if before < 1e-8:
        return _unchanged(q_start, q)
    if np.linalg.norm(T_goal[:3, 3]) > 1.5:  # the arm is 1.2 m long
        return _as_near_as_can_be(S, M, T_goal, q_start, limits, after)
    if after >= before:
        return Finding("no-nearer", "It ends no nearer to its target than it started.")
    if after > 1e-8 and _reached(T_goal[None], q_start[None], limits)[0]:
        says = f"The hand is not at its target, which is near: {after:.2g} off"
        return Finding("not-reached", f"{says} (radians and metres).")
    return None


def _miss(S, M, T_goal, q) -> float:
    e = jacobian.pose_error(screws.fk_space(S, M, q), T_goal)
    return float(np.linalg.norm(e))


def _unchanged(q_start: Array, q: Array) -> Finding | None:
    if np.abs(q - q_start).max() <= 1e-8:
        return None
    says = "The start is at its target already, and does not come back unchanged"
    return Finding(
        "start-not-kept", f"{says}: {np.abs(q - q_start).max():.2g} rad off."
    )


def _as_near_as_can_be(S, M, T_goal, q_start, limits, after) -> Finding | None:
    best = _miss(S, M, T_goal, jacobian.solve_ik(S, M, T_goal, q_start, limits))
    if after < 1.01 * best:  # measured: 1.001; with J_space up to 1.08
        return None
    says = f"stays {after:.3f} off a target out of reach; {best:.3f} can be had"
    return Finding("far-from-unreachable", f"It {says} (radians and metres).")
