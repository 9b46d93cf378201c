"""What `solve_ik` is asked, and how its answers are judged: by where the hand is.

Near targets have to be reached, to 1e-8; of those out of reach, and of those that only
lead through a joint limit, an answer has to come near. Nothing may leave the limits.
Where the docstring's loop has one way only to go, an answer has to end as near.
"""

import numpy as np

from labkit.judge import Finding, rounded
from labkit.judge.answers import once
from robo47 import jacobian, panda, screws
from robo47.checks import Array

from .jacobians import arm
from .loop import walk

# Joint 4 may go to -0.07 only: the target wants more. Then one at joint 6's and joint
# 7's limits, which a loop that keeps the limits at its end alone does not find.
START_4 = np.array([0.4, 0.5, -0.3, -0.2, 0.5, 1.2, 0.3])
BEYOND_4 = np.array([0.5, 0.4, -0.2, -0.02, 0.6, 1.4, 0.4])
START_6 = np.array([-1.605, -0.761, 0.885, -2.204, -2.157, 0.076, -1.154])
AT_6 = np.array([-1.44, -1.026, 0.941, -2.329, -2.077, -0.017, -2.897])
# Near, and yet 34 steps away: the way leads along joint 2's limit.
START_2 = np.array([-0.775, -1.623, -1.586, -2.163, -0.907, 1.989, -0.731])
AT_2 = np.array([-0.646, -1.7628, -1.382, -2.193, -0.649, 1.929, -1.005])
# Joint 6 may go to 3.75: an angle beyond pi that is wrapped leaves its limits.
START_PI = np.array([0.5, 0.4, -0.3, -2.0, 0.5, 3.25, 0.6])
BEYOND_PI = np.array([0.55, 0.45, -0.3, -1.9, 0.5, 3.35, 0.6])
# A turn by 2.5 rad about y from here meets no limit, and leads into a valley: the
# best q that the loop has passed is a third nearer than its last.
FAR_START = np.array([0.578, 0.069, 0.367, -1.654, -1.832, 2.08, 1.819])


def targets(rng):
    """Return a solved start, chosen targets, near ones, two out of reach, near ones.

    The near ones at the end are drawn again at each check.
    """
    S, M, limits = arm()
    start, goal = _near_targets(rng, 30, 0.7)
    some = np.flatnonzero(_reached(goal, start, limits))[:15]
    start, goal = start[some], goal[some]
    goal[0] = screws.fk_space(S, M, panda.READY_Q)
    start[0] = panda.READY_Q
    start[1:3], goal[1:3] = _by_the_limits(rng)
    out = goal[9:11, :3, 3]
    out *= 2.0 / np.linalg.norm(out, axis=1)[:, None]
    rows = [(S, M, T, q, limits) for T, q in zip(goal, start, strict=True)]
    return [rows[0], *_chosen(), *rows[1:]]


def _chosen() -> list[tuple[Array, ...]]:
    """Return a pure turn, a pure move, targets at limits, one far turn, and none."""
    S, M, limits = arm()
    at, turned = screws.fk_space(S, M, np.array([panda.READY_Q, FAR_START]))
    limited = screws.fk_space(S, M, np.array([BEYOND_4, AT_6, AT_2, BEYOND_PI]))
    moved = at.copy()
    moved[2, 3] -= 0.1
    goals = [_turned(at, 2, 0.5), moved, *limited, _turned(turned, 1, 2.5), turned]
    starts = [panda.READY_Q, panda.READY_Q, START_4, START_6, START_2]
    starts += [START_PI, FAR_START, FAR_START]
    return [(S, M, T, q, limits) for T, q in zip(goals, starts, strict=True)]


def _turned(T: Array, axis: int, angle: float) -> Array:
    """Return a pose turned in place about an axis of the world."""
    out = T.copy()
    out[:3, :3] = screws.exp_rotation(np.eye(3)[axis], angle) @ T[:3, :3]
    return out


def _near_targets(rng, n: int, part: float) -> tuple[Array, Array]:
    """Return starts in a part of the joints' ranges, and targets near them."""
    S, M, limits = arm()
    middle = limits.mean(axis=1)
    start = rounded(middle + part * (rng.configurations(n) - middle))
    near = np.clip(start + rng.numbers(-0.3, 0.3, n, 7), *limits.T)
    return start, screws.fk_space(S, M, near)


def _by_the_limits(rng) -> tuple[Array, Array]:
    """Return two starts and targets that lead far beyond a limit, if none is kept."""
    S, M, limits = arm()
    start, goal = _near_targets(rng, 30, 0.99)
    q = walk(S, M, goal, start, None)
    beyond = np.maximum(limits[:, 0] - q, q - limits[:, 1]).max(axis=1)
    some = np.argsort(-beyond)[:2]
    return start[some], goal[some]


@once
def _reached(goal: Array, start: Array, limits: Array, steps: int = 25) -> np.ndarray:
    """Return whether the right loop has steps to spare for a target, (n,)."""
    S, M, _ = arm()
    q = walk(S, M, goal, start, limits, steps=steps)
    return jacobian.reached(S, M, goal, q)


def arrived(S, M, T_goal, q_start, limits, q) -> Finding | None:
    """Return what is wrong with an answer of solve_ik, or None."""
    if not np.isfinite(q).all():
        return Finding("not-finite", "Your result has entries that are not finite.")
    beyond = np.maximum(limits[:, 0] - q, q - limits[:, 1])
    if beyond.max() > 1e-12:
        i = int(np.argmax(beyond))
        says = f"joint{i + 1} is {beyond[i]:.3g} rad beyond its limit."
        return Finding(
            "beyond-a-limit", f"Your result violates the joint limits: {says}"
        )
    before, after = _miss(S, M, T_goal, q_start), _miss(S, M, T_goal, q)
    if before < 1e-8:
        return _unchanged(q_start, q)
    if np.linalg.norm(T_goal[:3, 3]) > 1.5:  # the arm is 1.2 m long
        return _as_near_as_can_be(S, M, T_goal, q_start, limits, after)
    if found := _half_there(S, M, T_goal, q):
        return found
    if after >= before:
        return Finding(
            "no-nearer", "Your result is not closer to the target than the start."
        )
    if after <= 1e-8:
        return None
    if _reached(T_goal, q_start, limits, 45):
        says = "Your result does not reach a nearby target. The norm of its pose error "
        says += f"is {after:.2g} (in rad and m). "
        return Finding("not-reached", says + _why(beyond))
    return _as_the_docstring(T_goal, q_start, limits, after)


def _why(beyond: Array) -> str:
    """Return what to check of a loop that does not arrive, by how far q is beyond."""
    says = "Does your loop stop before this norm is below 1e-8? "
    if beyond.max() > -1e-9:
        says += "Does your code apply the joint limits after each step? "
    return (
        f"{says}Or are the steps too short, for example because the damping differs "
        "from the damping in the docstring?"
    )


def _half_there(S, M, T_goal, q) -> Finding | None:
    """Return that only the position, or only the rotation, is right."""
    e = jacobian.pose_error(screws.fk_space(S, M, q), T_goal)
    turn = np.linalg.norm(e[:3])
    move = np.linalg.norm(e[3:])
    if move < 1e-8 and turn > 1e-4:
        says = (
            f"The hand's position is correct, but its rotation is off by {turn:.2g} "
            "rad. Does your loop use only the position error in the steps, in the "
            "stopping test or in the choice of the best q?"
        )
        return Finding("position-only", says)
    if turn < 1e-8 and move > 1e-4:
        says = (
            "The hand's rotation is correct, but its position is "
            f"off by {1000 * move:.3g} mm. Does your loop use only the rotation error "
            "in the steps, in the stopping test or in the choice of the best q?"
        )
        return Finding("rotation-only", says)
    return None


@once
def _certain(T_goal, q_start, limits) -> float:
    """Return how far off the docstring's loop ends; 0 where its way is not certain.

    It is where no limit is met, and a last digit of the start changes nothing.
    """
    S, M, _ = arm()
    starts = q_start + np.array([0.0, 0.0, 1e-7, -3e-7])[:, None]
    kept, free = (walk(S, M, T_goal, starts, some) for some in (limits, None))
    miss = np.linalg.norm(
        jacobian.pose_error(screws.fk_space(S, M, kept), T_goal), axis=1
    )
    least = float(miss[0])
    certain = np.abs(free[0] - kept[0]).max() < 1e-6 and np.ptp(miss) < 0.003 * least
    return least if certain else 0.0


def _as_the_docstring(T_goal, q_start, limits, after) -> Finding | None:
    """Return that the docstring's loop comes nearer, where its way is certain."""
    least = _certain(T_goal, q_start, limits)
    if least < 1e-3 or after < 1.1 * least:  # another damping: 1.08
        return None
    says = (
        "For a far target, the norm of the pose error of your result is "
        f"{after:.3g}, but 60 steps can reduce this norm to {least:.3g}"
    )
    return Finding(
        "not-the-best",
        f"{says} (in rad and m). Do the steps and the damping match the docstring? "
        "Does your code return the q with the smallest error? If your code changes q "
        "in place, keep a copy of the best q.",
    )


def _miss(S, M, T_goal, q) -> float:
    e = jacobian.pose_error(screws.fk_space(S, M, q), T_goal)
    return float(np.linalg.norm(e))


def _unchanged(q_start: Array, q: Array) -> Finding | None:
    if np.abs(q - q_start).max() <= 1e-8:
        return None
    says = "The start is already at the target, but your result differs from the start"
    return Finding("start-not-kept", f"{says} by {np.abs(q - q_start).max():.2g} rad.")


@once
def _best(*target) -> float:
    return _miss(*target[:3], jacobian.solve_ik(*target))


def _as_near_as_can_be(S, M, T_goal, q_start, limits, after) -> Finding | None:
    best = _best(S, M, T_goal, q_start, limits)
    if after < 1.01 * best:  # measured: 1.001; with J_space up to 1.08
        return None
    says = "For an unreachable target, the norm of the pose error of your result is "
    says += f"{after:.3f}, but {best:.3f} is possible (in rad and m)."
    return Finding("far-from-unreachable", says)
