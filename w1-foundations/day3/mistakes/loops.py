"""Mistakes in task 3.6: `solve_ik`, a loop of right or wrong parts.

`redo` takes screws (n, 7, 6), M and T_goal (n, 4, 4), q_start (n, 7) and limits
(n, 7, 2), and returns q, (n, 7). A loop that does not arrive wanders, so only its first
steps are sure to be the student's; a mistake is named where all its answers are.
"""

from collections.abc import Callable
from typing import Any

import numpy as np

from labkit.judge.matrices import transposed
from labkit.judge.mistake import Mistake
from robo47 import jacobian
from robo47.checks import Array
from robo47.panda import READY_Q
from robo47.screws import adjoint, fk_space, skew

from .errors import error, in_the_hands_axes
from .logs import LOG
from .steps import damped

Function = Callable[..., Any]
STEPS = 60


def at_site(J_space: Array, T: Array) -> Array:
    """Return J_site of the hand's own origin."""
    return jacobian.site_jacobian(J_space, T[:, :3, 3])


def adaptive(ee: Array) -> Array:
    """Return the squared damping of the docstring, from the squared error, (n,)."""
    return 0.5 * ee + 1e-6


def walk(
    S: Array,
    M: Array,
    goal: Array,
    q: Array,
    limits: Array,
    seen: Function = at_site,
    gap: Function = error,
    damping: Function = adaptive,
    steps: int = STEPS,
    clip: bool = True,
    keep: bool = True,
    step: Function | None = None,
    updated: bool = True,
) -> Array:
    """Return where the loop ends, (n, 7), with any part replaced.

    Args:
        S: screws of one arm, repeated, (n, 7, 6).
        M: (n, 4, 4).
        goal: (n, 4, 4).
        q: starts, (n, 7).
        limits: (n, 7, 2).
        seen: the Jacobian that is used, from J_space and T.
        gap: the error, from T and the goal.
        damping: the squared damping, from the squared error.
        steps: how many.
        clip: whether the limits are kept.
        keep: whether the best of all is returned, else the last.
        step: in place of the damped step, from J, e and the squared damping.
        updated: whether J is computed anew at each step.
    """
    S, M = S[0], M[0]
    step = step or (lambda J, e, d: damped(J, e, d[:, None, None] * np.eye(6)))
    best, least = q.copy(), np.full(len(q), np.inf)
    J: Array | None = None
    for _ in range(steps + 1):
        T = fk_space(S, M, q)
        e = gap(T, goal)
        ee = np.sum(e * e, axis=1)
        better = (ee < least) | (not keep)
        best[better], least[better] = q[better], ee[better]
        going = (ee >= 1e-16)[:, None]
        if J is None or updated:
            J = seen(jacobian.space_jacobian(S, q), T)
        q = np.where(going, q + step(J, e, damping(ee)), q)
        if clip:
            q = np.clip(q, limits[..., 0], limits[..., 1])
    return best


def _with(**parts: Any) -> Function:
    def redo(S: Array, M: Array, goal: Array, q: Array, limits: Array) -> Array:
        with np.errstate(all="ignore"):
            return walk(S, M, goal, q, limits, **parts)

    return redo


def _log_of(slug: str) -> Function:
    log = next(m.redo for m in LOG if m.slug == slug)
    return lambda T, goal: error(T, goal, log)


def _half_negated(T: Array, goal: Array) -> Array:
    return error(T, goal) * np.repeat([-1.0, 1.0], 3)


def _rotation_only_turned(T: Array, goal: Array) -> Array:
    e = error(T, goal)
    e[:, :3] = jacobian.log_rotation(transposed(T[:, :3, :3]) @ goal[:, :3, :3])
    return e


def _at_zero(S: Array, M: Array) -> Function:
    return lambda J_space, T: jacobian.site_jacobian(J_space, M[0, :3, 3])


def _body(J_space: Array, T: Array) -> Array:
    R, p = T[:, :3, :3], T[:, :3, 3]
    back = np.concatenate([transposed(R), -transposed(R) @ p[..., None]], axis=-1)
    inverse = np.concatenate(
        [back, np.broadcast_to([[[0, 0, 0, 1]]], (len(T), 1, 4))], 1
    )
    return adjoint(inverse) @ J_space


def _cross_sign(J_space: Array, T: Array) -> Array:
    v = J_space[:, 3:] + skew(T[:, :3, 3]) @ J_space[:, :3]
    return np.concatenate([J_space[:, :3], v], axis=1)


# What passes a convergence test for many targets, by name: the thread of the day.
PARTS: dict[str, dict[str, Any]] = {
    "right": {},
    "space-jacobian": {"seen": lambda J_space, T: J_space},
    "body-jacobian": {"seen": _body},
    "quaternion-vector-part": {"gap": _log_of("quaternion-vector-part")},
    "sine-for-angle": {"gap": _log_of("sine-for-angle")},
    "rotation-in-the-hands-axes": {"gap": _rotation_only_turned},
    "rotation-sign": {"gap": _half_negated},
    "error-sign": {"gap": lambda T, goal: -error(T, goal)},
    "error-halves-swapped": {"gap": lambda T, goal: np.roll(error(T, goal), 3, axis=1)},
    "jacobian-never-updated": {"updated": False},
    "damping-not-squared": {"damping": lambda ee: np.sqrt(adaptive(ee))},
    "damping-fixed": {"damping": lambda ee: np.full_like(ee, 0.05**2)},
    "transpose-only": {"step": lambda J, e, d: (transposed(J) @ e[..., None])[..., 0]},
}

SOLVE_IK = [
    Mistake(
        "space-jacobian",
        "the steps are made with J_space: its v is that of another point than the "
        "hand's",
        _with(**PARTS["space-jacobian"]),
        "what J_space leads to",
    ),
    Mistake(
        "body-jacobian",
        "the steps are made with J_body, in the hand's axes; the error is in the "
        "world's",
        _with(**PARTS["body-jacobian"]),
        "what J_body leads to",
    ),
    Mistake(
        "error-in-the-hands-axes",
        "the error is in the hand's axes; J_site is in the world's",
        _with(gap=in_the_hands_axes),
        "what that error leads to",
    ),
    Mistake(
        "damping-not-squared",
        "the squared damping is handed over as the damping, or its root is forgotten",
        _with(damping=lambda ee: adaptive(ee) ** 2),
        "what that damping leads to",
    ),
    Mistake(
        "damping-not-squared",
        "the damping in it is too large by far: it is not squared",
        _with(**PARTS["damping-not-squared"]),
        "what that damping leads to",
    ),
    Mistake(
        "limits-forgotten",
        "the joint limits are not kept",
        _with(clip=False),
        "what the loop without limits leads to",
    ),
    Mistake(
        "jacobian-never-updated",
        "the Jacobian is that of the start; it changes with every step",
        _with(**PARTS["jacobian-never-updated"]),
        "what the first Jacobian leads to",
    ),
    Mistake(
        "q-start-unused",
        "the loop starts from READY_Q: q_start is not used",
        lambda S, M, goal, q, limits: walk(
            S, M, goal, np.broadcast_to(READY_Q, q.shape).copy(), limits
        ),
        "what READY_Q leads to",
    ),
    Mistake(
        "q-start-unused",
        "the loop starts from q = 0, whatever q_start is",
        lambda S, M, goal, q, limits: walk(S, M, goal, np.zeros_like(q), limits),
        "what q = 0 leads to",
    ),
    Mistake(
        "one-step",
        "there is one step only; the Jacobian is a straight line along a curve, so it "
        "takes several",
        _with(steps=1, keep=False),
        "where one step leads",
    ),
    Mistake(
        "start-returned",
        "the start comes back: no step is taken, or each one leads away from the "
        "target (then the sign of the error is wrong)",
        lambda S, M, goal, q, limits: q,
        "q_start",
    ),
    Mistake(
        "step-returned",
        "the last step comes back, not the configuration that the steps lead to",
        lambda S, M, goal, q, limits: np.zeros_like(q),
        "a step of 0",
    ),
]
