"""What Day 3's functions are asked, and what a right answer is.

The truth comes from `robo47.jacobian`, which its own tests hold against MuJoCo,
Pinocchio and the textbook; `solve_ik` is judged by where its answers bring the hand.
"""

import numpy as np

from labkit.judge import Ask, HeldOut, Jacobian, Vector, draw
from robo47 import jacobian, screws, se3
from robo47.checks import Array

from . import targets
from .kinds import Gap, Number, Numbers
from .mistakes import angles, errors, jacobians, logs, loops, measures, points, steps

NEAR = 1e-5
ROTVEC = ("x", "y", "z")
JOINTS = tuple(f"joint{i}" for i in range(1, 8))
UNIT = np.hstack([np.eye(6), np.zeros((6, 1))])  # a Jacobian of unit columns


def _jacobians(q: Array) -> Array:
    """Return J_site of the Panda's hand, rounded so that it can be typed."""
    S, M, _ = targets.arm()
    p = screws.fk_space(S, M, q)[:, :3, 3]
    return draw.rounded(jacobian.site_jacobian(jacobian.space_jacobian(S, q), p))


def _other_arm(rng) -> Array:
    """Return screws of an arm that nobody has: unit axes, points anywhere."""
    points = draw.numbers(rng, -1, 1, 7, 3)
    return screws.screw_axis(draw.units(rng, 7), points)


def _screws_and_q(rng):
    S, _, _ = targets.arm()
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
    angles = [
        1e-9,
        1e-7,
        1e-6,
        5e-6,
        1e-5,
        1e-3,
        0.3,
        *(np.pi - np.array([1e-2, 1e-4, 1e-6, 1e-8])),
    ]
    angles += [2.0, *rng.uniform(0.2, 3.0, 5)]
    R = screws.exp_rotation(draw.units(rng, len(angles)), np.array(angles))
    rounded = np.diag([1.0, 1.0, 1.0 + 2.0**-51])  # a trace of 3 and a last digit
    return [(se3.Rz(np.pi / 2),), (np.eye(3),), (rounded,), *((one,) for one in R)]


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


def _steps_without_damping(rng):
    J = _jacobians(draw.configurations(rng, 3))
    return [
        (one, e, 0.0) for one, e in zip(J, draw.numbers(rng, -1, 1, 3, 6), strict=True)
    ]


def _only_J(rng):
    first = np.hstack([np.diag([1.0, 2.0, 3.0, 1.0, 1.0, 1.0]), np.zeros((6, 1))])
    return [
        (first,),
        *((J,) for J in targets.SINGULAR),
        *((J,) for J in _near_singular(rng)),
    ]


def _J_and_dq(rng):
    J = _jacobians(draw.configurations(rng, 9))
    J[0, 0] = 0.0  # rank 5: two motions are not felt
    return [(UNIT, np.ones(7)), *zip(J, draw.numbers(rng, -1, 1, 9, 7), strict=True)]


def _J_and_T(rng):
    S, M, _ = targets.arm()
    q = draw.configurations(rng, 8)
    J = jacobian.space_jacobian(S, q)
    same = (J[0], np.eye(4))
    return [same, *zip(J, screws.fk_space(S, M, q), strict=True)]


HALF_TURN = HeldOut(
    "wrong-at-pi",
    "Right below pi, but not at exactly pi. There R - R^T is 0, so it knows neither "
    "the axis nor its sign: the docstring says which sign to return.",
    _half_turns,
)
AT_NO_DAMPING = HeldOut(
    "zero-without-damping",
    "Right, but with damping 0 it returns zeros. There the formula is the plain "
    "pseudo-inverse's step, which step 6 of the lab takes.",
    _steps_without_damping,
    mistaken=lambda J, e, damping: np.zeros(J.shape[::2]),
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
        Numbers((3,), "rad", names=ROTVEC),
        truth=jacobian.log_rotation,
        mistakes=[*logs.LOG, *logs.NOT_FINITE],
        unnamed=angles.where_the_angle_fails,
        near_miss=angles.where_the_digits_go,
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
        held_out=[AT_NO_DAMPING],
        near=NEAR,
    ),
    "solve_ik": Ask(
        targets.targets,
        Vector((7,), "rad", names=JOINTS),
        accept=targets.arrived,
        mistakes=lambda: loops.SOLVE_IK,
    ),
    "manipulability": Ask(
        _only_J,
        Number(),
        truth=jacobian.manipulability,
        mistakes=measures.MANIPULABILITY,
        tolerance=1e-6,
        near=NEAR,
    ),
    "null_step": Ask(
        _J_and_dq,
        Vector((7,), "rad", names=JOINTS),
        truth=jacobian.null_step,
        mistakes=measures.NULL,
        unnamed=measures.what_the_hand_feels,
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

# One thing with two names: on these questions the numbers are the same.
ALIKE = {"site_jacobian": [{"omega-changed", "halves-read-as-v-omega"}]}
