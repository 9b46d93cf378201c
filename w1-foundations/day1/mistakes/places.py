"""Where in the arm: the one link or joint that is wrong, or from which one on."""

from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np

from labkit.judge import Case, Finding, Mistake, Pose
from labkit.judge.chain import Factor, first_wrong, one_place, steady
from labkit.judge.compare import matches, rigid
from labkit.judge.matrices import rigid_inverse
from robo47.checks import Array

from .arm import Arm, whole
from .ends import wrong_ends, wrong_lengths
from .factors import JOINT_T, LINK_T, link, turn
from .products import of_a_product

STOPS = ("link1", "link2", "link3", "link4", "link5", "link6", "link7", "attachment")


def mistakes_of(arm: Arm) -> list[Mistake]:
    """Return every named mistake of a product along an arm."""
    ends = wrong_ends(arm) if arm is whole() else []
    found = [*ends, *wrong_lengths(arm, whole()), *of_a_product(arm)]
    return [replace(m, redo=lambda model, q, redo=m.redo: redo(q)) for m in found]


def unnamed(arm: Arm) -> Callable[[Case], Finding | None]:
    """Return the hook that says where a pose that no mistake gives goes wrong."""

    def where(case: Case) -> Finding | None:
        _, q = case.arguments[:2]
        if not rigid(case.S):
            return None
        if found := one_place(case.S, case.T, factors(arm, q)):
            return found
        if arm is whole() and (found := _two_mistakes(case.S, case.T, q)):
            return found
        found = Pose().what_is_wrong(case.S, case.T)
        return Finding(found.slug, f"{found.message} {_from_where(case, arm)}".strip())

    return where


def factors(arm: Arm, q: Array) -> list[Factor]:
    """Return the product along an arm, each factor with what may stand in its place."""
    found = []
    for k, step in enumerate(arm.steps(q)):
        L = np.broadcast_to(step[0], (len(q), 4, 4))
        found.append(Factor(arm.names[k], L, True, lambda k=k: _other_links(arm, k)))
        if len(step) > 1:
            name = f"joint{k + 1}"
            found.append(
                Factor(
                    name,
                    step[1],
                    False,
                    lambda k=k, name=name: _other_joints(name, k, q),
                    lambda X, name=name: _wrong_angle(name, X),
                )
            )
    return found


def measured(case: Case) -> tuple[str, ...]:
    """Return how far off poses are at zero, when ready and elsewhere."""
    zero, ready, other = (
        Pose().apart(case.S[i], case.T[i])
        for i in (slice(1), slice(1, 2), slice(2, None))
    )
    return (f"off at q = 0 by {zero}, when ready by {ready}, else by up to {other}",)


def _from_where(case: Case, arm: Arm) -> str:
    """Return from which prefix of the path on the student's pose is wrong."""
    if not case.probes:
        return ""
    q = case.probes[0][0][1]
    right = [arm.upto(k + 1).fk(q[None])[0] for k in range(len(case.probes))]
    return first_wrong(STOPS, [answer for _, answer in case.probes], right)


def _other_links(arm: Arm, k: int) -> Iterator[tuple[Finding, Array]]:
    name, pos, quat = arm.names[k], arm.pos[k : k + 1], arm.quat[k : k + 1]
    right = link(pos, quat)
    missing = f"The step to {name} is missing from your chain"
    yield Finding("link-skipped", missing), np.eye(4)[None]
    yield (
        Finding("link-twice", f"The step to {name} is in your chain twice"),
        (right @ right),
    )
    for mistake in LINK_T:
        says = f"In the step to {name} alone, {mistake.says}"
        yield Finding(mistake.slug, says), mistake.redo(pos, quat)


def _other_joints(name: str, k: int, q: Array) -> Iterator[tuple[Finding, Array]]:
    never = f"{name} never turns: its angle has no effect"
    yield Finding("joint-skipped", never), np.eye(4)[None]
    for j in set(range(q.shape[1])) - {k}:
        says = f"{name} turns by joint{j + 1}'s angle"
        yield Finding("joint-fed-another", says), turn(q[:, j])
    for mistake in JOINT_T:
        says = f"In {name}'s factor alone, {mistake.says}"
        yield Finding(mistake.slug, says), mistake.redo(q[:, k])


def _wrong_angle(name: str, X: Array) -> Finding | None:
    if not matches(X, turn(np.arctan2(X[:, 1, 0], X[:, 0, 0]))):
        return None
    says = f"{name} turns about its axis, but by the wrong angle"
    return Finding("joint-angle-off", says)


def _two_mistakes(S: Array, T: Array, q: Array) -> Finding | None:
    """Return a mistake all along the arm and a wrong end, if together they fit."""
    right = whole().fk(q)
    for first in of_a_product(whole()):
        if not rigid(again := first.redo(q)):
            continue
        X = rigid_inverse(again) @ S
        for end in wrong_ends(whole()) if steady(X) else ():
            if matches(X, rigid_inverse(right) @ end.redo(q)):
                return _both(first, end, S, T)
    stops = next(m for m in wrong_ends(whole()) if m.slug == "stops-at-link7")
    for first in of_a_product(whole().upto(7)):
        if matches(S, first.redo(q)):
            return _both(first, stops, S, T)
    return None


def _both(first: Mistake, second: Mistake, S: Array, T: Array) -> Finding:
    return Finding(
        f"{first.slug}+{second.slug}",
        f"Two things: {first.says}; and {second.says}. (Off by up to "
        f"{Pose().apart(S, T)}; with both put right, by 0.)",
    )
