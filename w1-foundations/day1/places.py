"""Where in the arm: the one link or joint that is wrong, or from which one on."""

from collections.abc import Callable, Iterator

import numpy as np

from labkit.judge import Case, Finding, HeldOut, Mistake, Pose, Slip
from labkit.judge.answers import difference, matches, rigid
from labkit.judge.chain import Factor, first_wrong, one_place
from labkit.judge.matrices import pose, rigid_inverse
from labkit.judge.mistake import both_told
from robo47 import se3
from robo47.checks import Array

from . import ends, joint_T, link_T
from .panda_chain import (
    BACKWARDS,
    FLANGE_QUAT,
    OTHER,
    PATH,
    as_written,
    fk,
    link,
    on,
    turn,
)
from .quat_to_R import UNNORMALISED

# One thing with two names: the numbers are the same, and what is said of either is true
# of both.
ALIKE = [BACKWARDS, {"joints-left-out", "R-lost"}]
TYPED_IN = HeldOut(
    "typed-in",
    "Your pose is correct for this Panda, but not for a Panda with longer links and "
    "a rotated link. Read every `pos` and `quat`, including the values of link0, "
    "from the given model.",
    on(OTHER, count=2),
    of_close=False,  # `flange` says more of a nearly right one
)
NO_INDEX = Slip(
    r"inhomogeneous|only (length-1|0-dimensional) arrays|sequence|ambiguous",
    r"\.qposadr\b(?!\s*\[)",
    "qposadr-is-an-array",
    "`model.joint(name).qposadr` is an array with one entry, so indexing `q` with this "
    "array also returns an array. Use `qposadr[0]` as the index.",
)  # fmt: skip


def along(path) -> Callable[[Case], Finding | None]:
    """Return the hook that says where a pose that no mistake gives goes wrong."""

    def where(case: Case) -> Finding | None:
        model, q = case.arguments[:2]
        if not rigid(case.S):
            return None
        if found := one_place(case.S, case.T, _factors(model, q, path)):
            return found
        if path is PATH and (found := _two_mistakes(case)):
            return found
        found = Pose().what_is_wrong(case.S, case.T)
        return Finding(found.slug, f"{found.message} {_from_where(case)}".strip())

    return where


def measured(case: Case) -> tuple[str, ...]:
    """Return how far off poses are at zero, when ready and elsewhere."""
    zero, ready, other = (
        Pose().apart(case.S[i], case.T[i])
        for i in (slice(1), slice(1, 2), slice(2, None))
    )
    known = f"error at q = 0: {zero}; in the ready configuration: {ready}"
    return (f"{known}; elsewhere: up to {other}",)


def flange(case: Case) -> Finding | None:
    """The file gives the flange's rotation to seven digits; MuJoCo normalises it."""
    off = difference(case.S, case.T).max()
    right = se3.quat_to_R(FLANGE_QUAT).T

    def ends_in(R_flange: Array) -> bool:
        again = case.T @ pose(right @ R_flange, np.zeros(3))
        return bool(difference(case.S, again).max() < 0.01 * off)

    says = f"Your result is close, but it is off by {off:.1e}."
    if any(ends_in(make(FLANGE_QUAT)) for make in UNNORMALISED):
        says += " The quaternion of `attachment` in the file is rounded, so its "
        says += "norm is not exactly 1. Normalise this quaternion."
        return Finding("flange-not-normalised", says)
    if ends_in(se3.Rz(0.75 * np.pi)):
        says += " Your code rotates `attachment` by exactly 135 degrees. Use the "
        says += "quaternion in the file instead, which is rounded to seven digits."
        return Finding("flange-turned-exactly", says)
    return None


def _factors(model, q: Array, path) -> list[Factor]:
    """Return the product's factors, each with what may stand in its place."""
    found = []
    for name, joint in path[1:]:  # link0's step does nothing
        L = np.broadcast_to(link(model, name), (len(q), 4, 4))
        others = lambda name=name: _other_links(model, name)  # noqa: E731
        found.append(Factor(name, L, True, others))
        if joint:
            others = lambda joint=joint: _other_joints(model, q, joint)  # noqa: E731
            off = lambda X, joint=joint: _wrong_angle(joint, X)  # noqa: E731
            found.append(Factor(joint, turn(model, q, joint), False, others, off))
    return found


def _from_where(case: Case) -> str:
    """Return from which prefix of the path on the student's pose is wrong."""
    asked = [(q, path.pairs) for (_, q, path), _ in case.probes]
    right = [fk(case.arguments[0], q, path) for q, path in asked]
    stops = [path[-1][0] for _, path in asked]
    return first_wrong(stops, [answer for _, answer in case.probes], right)


def _other_links(model, name: str) -> Iterator[tuple[Finding, Array]]:
    L = link(model, name)
    body = model.body(name)
    pos = body.pos[None]
    quat = as_written(body.quat)[None]
    missing = f"Your product omits the transform of {name}"
    yield Finding("link-skipped", missing), np.eye(4)
    yield (
        Finding("link-twice", f"Your product contains the transform of {name} twice"),
        L @ L,
    )
    for mistake in link_T.row.ask.named:
        says = f"A mistake in the transform of {name} alone would explain your result. "
        says += f"In this transform, {mistake.says}"
        yield Finding(mistake.slug, says), mistake.redo(pos, quat)


def _other_joints(model, q: Array, joint: str) -> Iterator[tuple[Finding, Array]]:
    yield (
        Finding(
            "joint-skipped",
            f"Your code does not rotate {joint}, so the angle of this joint has no "
            "effect",
        ),
        (np.eye(4)),
    )
    for _, other in PATH[1:-1]:
        if other != joint:
            says = f"Your code rotates {joint} by the angle of {other}"
            yield Finding("joint-fed-another", says), turn(model, q, other)
    angles = q[:, model.joint(joint).qposadr[0]]
    for mistake in joint_T.row.ask.named:
        says = f"A mistake in the transform of {joint} alone would explain your result."
        says += f" In this transform, {mistake.says}"
        yield Finding(mistake.slug, says), mistake.redo(angles)


def _wrong_angle(joint: str, X: Array) -> Finding | None:
    R = se3.Rz(np.arctan2(X[:, 1, 0], X[:, 0, 0]))
    if not matches(X, pose(R, np.zeros(3))):
        return None
    says = f"Your code rotates {joint} about the correct axis, but by the wrong angle"
    return Finding("joint-angle-off", says)


def _two_mistakes(case: Case) -> Finding | None:
    """Return a mistake all along the arm and a wrong end, if together they fit."""
    model, q = case.arguments
    elsewhere = {*ends.ENDS, "stops-early"}
    to_link7 = PATH[:-1]
    named = case.ask.named
    firsts = [m for m in named if m.slug not in elsewhere]
    for first in firsts:
        if _wrong_end(first, case, slice(-1, None)) and (
            end := _wrong_end(first, case, slice(None))
        ):
            return _both(Finding(first.slug, first.says), end, case)
    stops = next(Finding(m.slug, m.says) for m in named if m.slug == "stops-at-link7")
    for first in firsts:
        if matches(case.S[-1:], first.redo(model, q[-1:], to_link7)) and matches(
            case.S, first.redo(model, q, to_link7)
        ):
            says = first.says.replace("the end effector", "link7")
            says = says.replace("attachment", "link7")
            return _both(Finding(first.slug, says), stops, case)
    return None


def _wrong_end(first: Mistake, case: Case, some: slice) -> Finding | None:
    """Return the wrong end that, after another mistake, gives some of the answers."""
    model, q = case.arguments
    again = first.redo(model, q[some])
    if not rigid(again):
        return None
    X = rigid_inverse(again) @ case.S[some]
    slug, T_end = min(ends.ALL, key=lambda end: np.abs(X[-1] - end[1]).max())
    if not matches(X, np.broadcast_to(T_end, X.shape)):
        return None
    return next(Finding(slug, m.says) for m in case.ask.named if m.slug == slug)


def _both(first: Finding, second: Finding, case: Case) -> Finding:
    return Finding(
        f"{first.slug}+{second.slug}",
        f"{both_told(first.message, second.message)} "
        f"{Pose().largest_error(case.S, case.T)} Without both mistakes, the error "
        "would be 0.",
    )
