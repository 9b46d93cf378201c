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
    """one-step: there is one step only; the Jacobian is a straight line along a curve,
      so it takes several => where one step leads
    start-returned: the start comes back: no step is taken, or each one leads away from
      the target (then the sign of the error is wrong) => q_start
    step-returned: the last step comes back, not the configuration that the steps lead
      to => a step of 0
    """
    first = partial(passed, screws, M, T_goal, q_start, limits, steps=1)
    return {
        "one-step": lambda: list(first())[-1][0],
        "start-returned": q_start.copy(),
        "step-returned": np.zeros(7),  # what is left of a step where it has arrived
    }


# The loop with a wrong part.


def in_the_hands_axes(T, T_goal):
    """Return the error as the hand sees it."""
    return np.kron(np.eye(2), T[:3, :3].T) @ pose_error(T, T_goal)


@row.wrongs
def _(screws, M, T_goal, q_start, limits):
    """space-jacobian: the steps are made with J_space: its v is that of another point
      than the hand's => what J_space leads to
    body-jacobian: the steps are made with J_body, in the hand's axes; the error is in
      the world's => what J_body leads to
    error-in-the-hands-axes: the error is in the hand's axes; J_site is in the world's
    damping-not-squared: the damping in it is too large by far: it is not squared
    limits-forgotten: the joint limits are not kept
    jacobian-never-updated: the Jacobian is that of the start; it changes with every
      step => what the first Jacobian leads to
    q-start-unused: the loop starts from READY_Q: q_start is not used => what READY_Q
      leads to
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
    """the squared damping is handed over as the damping, or its root is forgotten =>
    what that damping leads to"""
    return walk(screws, M, T_goal, q_start, limits, damping=lambda ee: ee / 2 + 1e-6)


@row.wrong(hidden="few of its targets are at a limit")
def limits_at_the_end(screws, M, T_goal, q_start, limits):
    """the joint limits are kept at the end only; a loop that has left them goes another
    way, so keep them after each step => what the loop leads to, clipped at its end"""
    return np.clip(walk(screws, M, T_goal, q_start, None), *limits.T)


@row.wrong
def q_start_unused(screws, M, T_goal, q_start, limits):
    """the loop starts from q = 0, whatever q_start is => what q = 0 leads to"""
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


WRAPPED = "the angles are wrapped to +-pi at the end; joint 6 may go to 3.75, and a "
WRAPPED += "joint that has turned beyond pi has not come back to -pi"
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
