"""The loop of `solve_ik`'s docstring with any part replaced, for one target or many."""

import numpy as np

from robo47.jacobian import dls_step, pose_error, site_jacobian, space_jacobian
from robo47.screws import fk_space


def at_hand(J_space, T):
    """Return J_site of the hand's own origin."""
    return site_jacobian(J_space, T[..., :3, 3])


def adaptive(ee):
    """Return the damping of the docstring from the squared error."""
    return np.sqrt(ee / 2 + 1e-6)


def passed(
    screws,
    M,
    T_goal,
    q,
    limits,
    seen=at_hand,
    gap=pose_error,
    damping=adaptive,
    steps=60,
):
    """Yield the configurations that the loop passes, each with its error.

    Args:
        screws: of one arm, (7, 6).
        M: (4, 4).
        T_goal: (..., 4, 4).
        q: starts, (..., 7).
        limits: (7, 2); None if they are not kept.
        seen: the Jacobian that is used, from J_space and T.
        gap: the error, from T and the goal.
        damping: from the squared error.
        steps: how many at most; a target that is reached takes no more.
    """
    for _ in range(steps + 1):
        T = fk_space(screws, M, q)
        e = gap(T, T_goal)
        yield q, e
        ee = np.sum(e * e, axis=-1)
        if (ee < 1e-16).all():
            return
        dq = dls_step(seen(space_jacobian(screws, q), T), e, damping(ee))
        q = np.where(ee[..., None] < 1e-16, q, q + dq)
        q = q if limits is None else np.clip(q, *limits.T)


def nearest(loop, part=slice(6)):
    """Return of the configurations passed those whose error is the shortest, (..., 7).

    Args:
        loop: from `passed`.
        part: of the error that counts.
    """
    q, e = map(np.array, zip(*loop, strict=True))
    best = np.linalg.norm(e[..., part], axis=-1).argmin(axis=0)
    return np.take_along_axis(q, best[None, ..., None], axis=0)[0]


def walk(*target, **parts):
    """Return where the loop ends, (..., 7); with the arguments of `passed`."""
    return nearest(passed(*target, **parts))
