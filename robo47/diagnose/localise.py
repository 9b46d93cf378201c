"""Where in the arm: the one link or the one joint that is wrong, or from which one on.

The right product, cut before or after a joint, is A @ B. If the student's pose is
A @ X @ B with the same X at every q, then all but that place is right, and X is what
went wrong there. If X is a turn about z that changes with q, it is the joint.
"""

from collections.abc import Iterator

import numpy as np

from robo47.checks import Array
from robo47.diagnose.arm import Arm, product
from robo47.diagnose.cases import BASE
from robo47.diagnose.compare import apart, difference, matches
from robo47.diagnose.form import Finding
from robo47.diagnose.matrices import rigid_inverse
from robo47.diagnose.mistakes.factors import JOINT_T, LINK_T, link, turn

STEADY = 1e-5  # how far a constant may wander: a student's float32


def one_place(S: Array, T: Array, q: Array, arm: Arm) -> Finding | None:
    """Return which single link or joint is wrong, if one alone explains every answer.

    Args:
        S: the student's poses, rigid, (n, 4, 4).
        T: the right ones.
        q: joint angles, (n, 7).
        arm: the right chain.
    """
    rest = f"(Differs by up to {apart(S, T)}; with that put right, by 0.)"
    links = [(k, X) for k, X in _in_place_of(S, q, arm, 0) if steady(X)]
    joints = list(_in_place_of(S, q, arm, 1))
    for k, X in links:
        if named := _named_link(k, X[:1], arm):
            return Finding(named[0], f"{named[1]}. {rest}")
    for k, X in joints:
        if named := _named_joint(k, X, q):
            return Finding(named[0], f"{named[1]}. {rest}")
    return _unnamed_link(links, rest, arm) or _unnamed_joint(joints, rest)


def first_wrong_joint(S: Array, T: Array, arm: Arm) -> str:
    """Return from which joint on the student's chain is wrong, in a sentence, or "".

    Turning one joint alone moves the pose by S_turned @ inv(S_base), which depends on
    that joint's axis in the world only: on the chain up to it. A step that is wrong
    along joint k's own axis shows at joint k + 1 first, so both steps are named.

    Args:
        S: the student's poses at `cases.configurations()`, rigid, (n, 4, 4).
        T: the right ones.
        arm: the right chain.
    """
    base, alone = BASE, slice(BASE + 1, BASE + 1 + arm.joints)
    ours = T[alone] @ rigid_inverse(T[base])
    theirs = S[alone] @ rigid_inverse(S[base])
    right = difference(ours, theirs) < STEADY
    if right.all():
        return ""
    k = int(np.argmin(right))
    if k == 0:
        return (
            "Already joint1, turned alone, does not move it as it should: look at the "
            "step to link1 and the order of the product."
        )
    before = "joint1 moves it" if k == 1 else f"joints 1 to {k} move it"
    return (
        f"Turned alone, {before} as it should, but joint{k + 1} does not: look at the "
        f"steps to link{k} and link{k + 1}."
    )


def _in_place_of(
    S: Array, q: Array, arm: Arm, which: int
) -> Iterator[tuple[int, Array]]:
    """Yield per link (which = 0) or joint (1) what the student has in its place."""
    steps = arm.steps(q)
    factors = [factor for step in steps for factor in step]
    for k, step in enumerate(steps):
        if which < len(step):
            i = 2 * k + which
            before, after = (
                product(part, len(q)) for part in (factors[:i], factors[i + 1 :])
            )
            yield k, rigid_inverse(before) @ S @ rigid_inverse(after)


def steady(X: Array) -> bool:
    """Return whether X, (n, 4, 4), is the same at every q."""
    return float(np.abs(X - X[0]).max()) < STEADY


def _named_link(k: int, X: Array, arm: Arm) -> tuple[str, str] | None:
    name, pos, quat = arm.names[k], arm.pos[k : k + 1], arm.quat[k : k + 1]
    right = link(pos, quat)
    if matches(X, np.eye(4)[None]):
        return "link-skipped", f"The step to {name} is missing from your chain"
    if matches(X, right @ right):
        return "link-twice", f"The step to {name} is in your chain twice"
    for mistake in LINK_T:
        if matches(X, mistake.redo(pos, quat)):
            return mistake.slug, f"In the step to {name} alone, {mistake.says}"
    return None


def _named_joint(k: int, X: Array, q: Array) -> tuple[str, str] | None:
    name = f"joint{k + 1}"
    if matches(X, np.broadcast_to(np.eye(4), X.shape)):
        return "joint-skipped", f"{name} never turns: its angle has no effect"
    for j in set(range(q.shape[1])) - {k}:
        if matches(X, turn(q[:, j])):
            return "joint-fed-another", f"{name} turns by joint{j + 1}'s angle"
    for mistake in JOINT_T:
        if matches(X, mistake.redo(q[:, k])):
            return mistake.slug, f"In {name}'s factor alone, {mistake.says}"
    return None


def _unnamed_link(
    links: list[tuple[int, Array]], rest: str, arm: Arm
) -> Finding | None:
    """A constant along a joint's own axis fits before it and after it: say both."""
    if not links:
        return None
    names = " or to ".join(arm.names[k] for k, _ in links)
    k, X = links[0]
    off = apart(X[:1], link(arm.pos[k : k + 1], arm.quat[k : k + 1]))
    return Finding(
        "one-link-off",
        f"One fixed step is wrong, the one to {names}: by {off}, the same at every q. "
        f"{rest}",
    )


def _unnamed_joint(joints: list[tuple[int, Array]], rest: str) -> Finding | None:
    for k, X in joints:
        angle = np.arctan2(X[:, 1, 0], X[:, 0, 0])
        if matches(X, turn(angle)):
            return Finding(
                "joint-angle-off",
                f"joint{k + 1} turns about its axis, but by the wrong angle. {rest}",
            )
    return None
