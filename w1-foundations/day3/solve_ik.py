"""3.6 `solve_ik(screws, M, T_goal, q_start, limits)`: its questions and its mistakes.

A loop that does not arrive wanders, so only its first steps are sure to be the
student's; a mistake is named where all its answers are.
"""

from functools import partial

import numpy as np

from labkit.judge import Row, Vector
from robo47.jacobian import body_jacobian, dls_step, pose_error, space_jacobian
from robo47.panda import READY_Q
from robo47.screws import fk_space

from . import targets
from .jacobians import JOINTS
from .loop import adaptive, at_hand, nearest, passed, walk

row = Row(Vector((7,), "rad", names=JOINTS), accept=targets.arrived)
row.inputs(targets.targets)

BOTH_MOVE = "there both halves move"


# Those that cost no loop come first.


@row.wrongs
def _(screws, M, T_goal, q_start, limits):
    """one-step: your code takes only one step. The Jacobian gives only a linear
      approximation, so repeat the step until the error is small
    start-returned: your code returns `q_start`. Does your loop change q, does the error
      have the correct sign, and does your code return the q with the smallest error?
    step-returned: your result is 0 for every joint, like the last step at the target.
      The result should be a configuration, not a step
    """
    first = partial(passed, screws, M, T_goal, q_start, limits, steps=1)
    return {
        "one-step": lambda: list(first())[-1][0],
        "start-returned": q_start.copy(),
        "step-returned": np.zeros(7),  # what is left of a step where it has arrived
    }


# The loop with a wrong part.


def in_the_hands_axes(T, T_goal):
    """Return the error, expressed in the hand frame."""
    return np.kron(np.eye(2), T[:3, :3].T) @ pose_error(T, T_goal)


@row.wrongs
def _(screws, M, T_goal, q_start, limits):
    """space-jacobian: your code computes the steps with J_space, whose v is the
      velocity of the body-fixed point at the world origin. Use J_site instead, whose v
      is the velocity of the hand
    body-jacobian: your code combines J_body, which is expressed in the hand frame, with
      an error that is expressed in the world frame. Express both in the same frame
    error-in-the-hands-axes: your code combines J_site, which is expressed in the world
      frame, with an error that is expressed in the hand frame. Express both in the same
      frame
    damping-not-squared: your steps contain the damping itself instead of its square, as
      in J J^T + damping I. Use damping^2 instead
    limits-forgotten: your code does not apply the joint limits. Apply the limits after
      each step
    jacobian-never-updated: your code computes the Jacobian only at the start. Compute a
      new Jacobian in every step, because the Jacobian depends on q
    q-start-unused: your code starts from READY_Q. Start from the argument `q_start`
      instead
    """
    J = at_hand(space_jacobian(screws, q_start), fk_space(screws, M, q_start))
    parts = {
        "space-jacobian": {"seen": lambda J_space, T: J_space},
        "body-jacobian": {"seen": body_jacobian},
        "error-in-the-hands-axes": {"gap": in_the_hands_axes},
        "damping-not-squared": {"damping": lambda ee: np.sqrt(adaptive(ee))},
        "limits-forgotten": {"limits": None},
        "jacobian-never-updated": {"seen": lambda J_space, T: J},
        "q-start-unused": {"q": READY_Q},
    }
    given = {"q": q_start, "limits": limits}
    return {
        slug: partial(walk, screws, M, T_goal, **{**given, **one})
        for slug, one in parts.items()
    }


@row.wrong(hidden="it arrives all the same: success is no proof")
def damping_not_squared(screws, M, T_goal, q_start, limits):
    """your steps contain damping^4 instead of damping^2. The damping is the square root
    of e.e / 2 + 1e-6, and `dls_step` already squares the damping"""
    return walk(screws, M, T_goal, q_start, limits, damping=lambda ee: ee / 2 + 1e-6)


@row.wrong(hidden="few of its targets are at a limit")
def limits_at_the_end(screws, M, T_goal, q_start, limits):
    """your code applies the joint limits only at the end. Apply the limits after each
    step"""
    return np.clip(walk(screws, M, T_goal, q_start, None), *limits.T)


@row.wrong
def q_start_unused(screws, M, T_goal, q_start, limits):
    """your code starts from q = 0. Start from the argument `q_start` instead"""
    return walk(screws, M, T_goal, np.zeros(7), limits)


# What `targets.arrived` says where the hand is.


@row.wrong("position-only")  # Only the translation is steered.
def _(*target):
    return walk(*target, gap=lambda T, goal: pose_error(T, goal) * [0, 0, 0, 1, 1, 1])


@row.wrong("position-only", hidden=BOTH_MOVE)  # The best is chosen by it.
def _(screws, M, T_goal, q_start, limits):
    return nearest(passed(screws, M, T_goal, q_start, limits), part=slice(3, 6))


def stopped(loop, part, at=1e-8):
    """Return the first q whose error is short enough, or else the best."""
    so_far = []
    for q, e in loop:
        so_far.append((q, e))
        if np.linalg.norm(e[part]) < at:
            break
    return nearest(so_far)


@row.wrong("position-only", hidden=BOTH_MOVE)  # It stops as soon as it is right.
def _(screws, M, T_goal, q_start, limits):
    return stopped(passed(screws, M, T_goal, q_start, limits), slice(3, 6))


@row.wrong("rotation-only", hidden=BOTH_MOVE)  # It stops as soon as it is right.
def _(screws, M, T_goal, q_start, limits):
    return stopped(passed(screws, M, T_goal, q_start, limits), slice(3))


@row.wrong("not-reached")  # Three digits are thought to be enough.
def _(screws, M, T_goal, q_start, limits):
    return stopped(passed(screws, M, T_goal, q_start, limits), slice(6), 1e-3)


@row.wrong("not-reached", hidden="few of its near targets take as many")  # 20 steps.
def _(*target):
    return walk(*target, steps=20)


@row.wrong("not-reached")  # Half of each step is taken.
def _(*target):
    return walk(*target, gap=lambda T, goal: pose_error(T, goal) / 2)


@row.wrong("not-reached")  # The damping is the same far away and near.
def _(screws, M, T_goal, q_start, limits):
    return walk(screws, M, T_goal, q_start, limits, damping=lambda ee: 0.3 + 0 * ee)


@row.wrong("start-not-kept")  # It starts beside q_start.
def _(screws, M, T_goal, q_start, limits):
    return walk(screws, M, T_goal, q_start + 0.05, limits)


@row.wrong("no-nearer")  # The middle of the limits comes back for what is not reached.
def _(screws, M, T_goal, q_start, limits):
    q = walk(screws, M, T_goal, q_start, limits)
    e = pose_error(fk_space(screws, M, q), T_goal)
    return q if np.linalg.norm(e) < 1e-8 else limits.mean(axis=1)


@row.wrong("not-the-best", hidden="its far targets end at their best")
def _(screws, M, T_goal, q_start, limits):
    return list(passed(screws, M, T_goal, q_start, limits))[-1][0]


@row.wrong("beyond-a-limit", hidden="joint 4 ends there seldom")
def _(screws, M, T_goal, q_start, limits):  # 0 is taken to be within all limits
    low, high = np.minimum(limits[:, 0], 0), np.maximum(limits[:, 1], 0)
    return walk(screws, M, T_goal, q_start, np.array([low, high]).T)


WRAPPED = "your code wraps the angles to [-pi, pi] at the end. Return the angles "
WRAPPED += "unchanged, because joint6 can move to 3.75 rad, and the wrapped angle "
WRAPPED += "would violate its limits"
for kept in (True, False):

    @row.wrong("wrapped-to-pi", WRAPPED)
    def _(screws, M, T_goal, q_start, limits, kept=kept):
        q = walk(screws, M, T_goal, q_start, limits if kept else None)
        return (q + np.pi) % (2 * np.pi) - np.pi


@row.wrong("start-returned")  # The error's sign.
def _(*target):
    return walk(*target, gap=lambda T, goal: -pose_error(T, goal))


@row.right  # The error and the Jacobian are the hand's: they go together too.
def _(*target):
    return walk(*target, seen=body_jacobian, gap=in_the_hands_axes)


@row.right  # The damping shrinks after a good step and grows after a bad one.
def _(screws, M, T_goal, q_start, limits):
    q = q_start.copy()
    damping = 0.1
    T = fk_space(screws, M, q)
    for _ in range(60):
        J = at_hand(space_jacobian(screws, q), T)
        e = pose_error(T, T_goal)
        new = np.clip(q + dls_step(J, e, damping), *limits.T)
        T_new = fk_space(screws, M, new)
        if np.linalg.norm(pose_error(T_new, T_goal)) < np.linalg.norm(e):
            q = new
            T = T_new
            damping = max(damping / 3, 1e-6)
        else:
            damping = 3 * damping
    return q


@row.wrong("shape")  # The number of steps comes back too.
def _(screws, M, T_goal, q_start, limits):
    return np.append(walk(screws, M, T_goal, q_start, limits), 60.0)


@row.wrong("raises")  # A target out of reach stops it.
def _(screws, M, T_goal, q_start, limits):
    q = walk(screws, M, T_goal, q_start, limits)
    if np.linalg.norm(pose_error(fk_space(screws, M, q), T_goal)) > 1e-8:
        raise ValueError("not reached")
    return q


STEP = "q = np.clip(q + dls_step(J, e, np.sqrt(e @ e / {} + {})), *limits.T)"
GIVEN = STEP.format(2, "1e-06")
for change, why in {
    "for _ in range(61): => for _ in range(122):": "more steps are right as well",
    "if least < 1e-08 ** 2: => if least < 0.5 * 1e-08 ** 2:": "so is one step more",
    "if least < 1e-08 ** 2: => if least < 1e-08 ** 4:": "so are some steps more",
    f"{GIVEN} => {STEP.format(2, '2e-06')}": "other dampings arrive as well",
    f"{GIVEN} => {STEP.format(4, '1e-06')}": "other dampings arrive as well",
}.items():
    row.same(change, why)
