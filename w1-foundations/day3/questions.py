"""What Day 3's functions are asked, and what a right answer is.

The truth comes from `robo47.jacobian`, which its own tests hold against MuJoCo,
Pinocchio and the textbook; `solve_ik` is judged by where its answers bring the hand.
"""

from dataclasses import dataclass
from functools import cache

import numpy as np

from robo47 import jacobian, panda, screws, se3
from robo47.checks import Array
from robo47.diagnose import (
    Ask,
    Finding,
    HeldOut,
    Jacobian,
    Scalar,
    Twist,
    Vector,
    draw,
)

from .mistakes import errors, jacobians, loops, points, steps

NEAR = 1e-5
ROTVEC = ("x", "y", "z")
JOINTS = tuple(f"joint{i}" for i in range(1, 8))
UNIT = np.hstack([np.eye(6), np.zeros((6, 1))])  # a Jacobian of unit columns


@dataclass(frozen=True)
class Gap(Twist):
    """A pose error: a rotation above, a translation below."""

    halves = ("the rotation", "the translation")


@cache
def arm() -> tuple[Array, Array, Array]:
    """Return the Panda's screws, M and joint limits."""
    model = panda.load("panda_nohand")
    return panda.screws(model), panda.home_pose(model), model.jnt_range.copy()


def _jacobians(q: Array) -> Array:
    """Return J_site of the Panda's hand, rounded so that it can be typed."""
    S, M, _ = arm()
    p = screws.fk_space(S, M, q)[:, :3, 3]
    return draw.rounded(jacobian.site_jacobian(jacobian.space_jacobian(S, q), p))


def _other_arm(rng) -> Array:
    """Return screws of an arm that nobody has: unit axes, points anywhere."""
    points = draw.numbers(rng, -1, 1, 7, 3)
    return screws.screw_axis(draw.units(rng, 7), points)


def _screws_and_q(rng):
    S, _, _ = arm()
    some = [draw.ZERO, draw.READY, *draw.configurations(rng, 4)]
    others = [(_other_arm(rng), q) for q in draw.configurations(rng, 2)]
    return [
        *((S, q) for q in some),
        *others,
        *((S, q) for q in draw.configurations(rng, 3)),
    ]


def _space_and_p(rng):
    spin = np.zeros((6, 7))
    spin[2] = 1.0
    drawn = draw.numbers(rng, -1, 1, 8, 6, 7)
    return [
        (spin, np.array([1.0, 0.0, 0.0])),
        *zip(drawn, draw.numbers(rng, -1, 1, 8, 3), strict=True),
    ]


def _turns(rng):
    """From 0 to nearly pi; the docstring's first, drawn ones last."""
    angles = [1e-9, 1e-5, 0.3, *(np.pi - np.array([1e-2, 1e-4, 1e-6, 1e-8]))]
    angles += [2.0, *rng.uniform(0.2, 3.0, 5)]
    R = screws.exp_rotation(draw.units(rng, len(angles)), np.array(angles))
    return [(se3.Rz(np.pi / 2),), (np.eye(3),), *((one,) for one in R)]


def _half_turns(rng):
    """Return turns by exactly pi; R is exactly symmetric."""
    axes = np.array([[1, 0, 0], [0, 1, 0], [0, 0, 1], [0.6, -0.8, 0], [0, 0.6, 0.8]])
    return [(2.0 * np.outer(n, n) - np.eye(3),) for n in axes]


def _two_poses(rng):
    higher = np.eye(4)
    higher[2, 3] = 0.1
    T = draw.poses(rng, 8)
    turn = screws.exp_rotation(draw.units(rng, 8), rng.uniform(0.05, 3.0, 8))
    goal = se3.make_T(turn @ T[:, :3, :3], draw.numbers(rng, -1, 1, 8, 3))
    return [(np.eye(4), higher), *zip(T, goal, strict=True)]


def _near_singular(rng) -> Array:
    """Return Jacobians of all sorts, (9, 6, 7): two are singular, nearly."""
    q = draw.configurations(rng, 9)
    q[1], q[2] = draw.ZERO, [0.0, 0.3, 0.0, -0.08, 0.0, 0.4, 0.2]
    return _jacobians(q)


def _steps(rng):
    e = draw.numbers(rng, -0.5, 0.5, 9, 6)
    damping = np.array([0.05, 0.02, 0.1, 0.3, 0.5, 2.0, 0.01, 0.2, 0.7])
    first = (UNIT, np.arange(1.0, 7.0) / 10, 1.0)
    return [first, *zip(_near_singular(rng), e, map(float, damping), strict=True)]


def _only_J(rng):
    first = np.hstack([np.diag([1.0, 2.0, 3.0, 1.0, 1.0, 1.0]), np.zeros((6, 1))])
    return [(first,), *((J,) for J in _near_singular(rng))]


def _J_and_dq(rng):
    J = _jacobians(draw.configurations(rng, 9))
    return [(UNIT, np.ones(7)), *zip(J, draw.numbers(rng, -1, 1, 9, 7), strict=True)]


def _J_and_T(rng):
    S, M, _ = arm()
    q = draw.configurations(rng, 8)
    J = jacobian.space_jacobian(S, q)
    same = (J[0], np.eye(4))
    return [same, *zip(J, screws.fk_space(S, M, q), strict=True)]


def _targets(rng):
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


HALF_TURN = HeldOut(
    "wrong-at-pi",
    "Right below pi, but not at exactly pi. There R - R^T is 0, so it knows neither "
    "the axis nor its sign: the docstring says which sign to return.",
    _half_turns,
)

QUESTIONS = {
    "space_jacobian": Ask(
        _screws_and_q,
        Jacobian(),
        truth=jacobian.space_jacobian,
        mistakes=jacobians.SPACE,
        near=NEAR,
    ),
    "site_jacobian": Ask(
        _space_and_p,
        Jacobian(),
        truth=jacobian.site_jacobian,
        mistakes=points.SITE,
        near=NEAR,
    ),
    "log_rotation": Ask(
        _turns,
        Vector((3,), "rad", names=ROTVEC),
        truth=jacobian.log_rotation,
        mistakes=errors.LOG,
        unnamed=errors.where_the_angle_fails,
        held_out=[HALF_TURN],
        near=NEAR,
    ),
    "pose_error": Ask(
        _two_poses,
        Gap(),
        truth=jacobian.pose_error,
        mistakes=errors.POSE_ERROR,
        near=NEAR,
    ),
    "dls_step": Ask(
        _steps,
        Vector((7,), "rad", names=JOINTS),
        truth=jacobian.dls_step,
        mistakes=steps.DLS,
        near=NEAR,
    ),
    "solve_ik": Ask(
        _targets,
        Vector((7,), "rad", names=JOINTS),
        accept=arrived,
        mistakes=lambda: loops.SOLVE_IK,
    ),
    "manipulability": Ask(
        _only_J,
        Scalar(),
        truth=jacobian.manipulability,
        mistakes=steps.MANIPULABILITY,
        tolerance=1e-6,
        near=NEAR,
    ),
    "null_step": Ask(
        _J_and_dq,
        Vector((7,), "rad", names=JOINTS),
        truth=jacobian.null_step,
        mistakes=steps.NULL,
        near=NEAR,
    ),
    "body_jacobian": Ask(
        _J_and_T,
        Jacobian(),
        truth=jacobian.body_jacobian,
        mistakes=points.BODY,
        near=NEAR,
    ),
}
