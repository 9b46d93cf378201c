"""The looks that only a product along the arm gets: tasks 1.6 and 1.8."""

from robo47.checks import Array
from robo47.diagnose import parts
from robo47.diagnose.arm import Arm, whole
from robo47.diagnose.compare import apart, matches, rigid
from robo47.diagnose.form import Finding
from robo47.diagnose.localise import first_wrong_joint, one_place, steady
from robo47.diagnose.matrices import rigid_inverse
from robo47.diagnose.mistakes.ends import wrong_ends, wrong_lengths
from robo47.diagnose.mistakes.mistake import Mistake
from robo47.diagnose.mistakes.products import of_a_product


def arm_of(function: str) -> Arm:
    """Return the chain that compose_fk or link4_to_world follows."""
    return whole() if function == "compose_fk" else whole().upto(4)


def mistakes(function: str) -> list[Mistake]:
    """Return every named mistake of compose_fk or link4_to_world."""
    arm = arm_of(function)
    ends = wrong_ends(arm) if arm is whole() else []
    return [*ends, *wrong_lengths(arm, whole()), *of_a_product(arm)]


def diagnose(function: str, S: Array, T: Array, q: Array, given: list[str]) -> Finding:
    """Return what is wrong with poses that no single named mistake gives.

    Args:
        function: compose_fk or link4_to_world.
        S: the student's poses, (n, 4, 4), finite.
        T: the right ones.
        q: joint angles, (n, 7).
        given: the inputs in words.
    """
    arm = arm_of(function)
    if not rigid(S):
        return parts.what_is_wrong(S, T, given)
    if found := one_place(S, T, q, arm):
        return found
    if arm is whole() and (found := _two_mistakes(S, T, q)):
        return found
    found = parts.what_is_wrong(S, T, given)
    where = first_wrong_joint(S, T, arm)
    return Finding(found.slug, f"{found.message} {where}".strip())


def measured(S: Array, T: Array) -> str:
    """Return how far off poses are at zero, at home and elsewhere, for --explain.

    Args:
        S: the student's poses at `cases.configurations()`, (n, 4, 4).
        T: the right ones.
    """
    zero, home, other = (
        apart(S[i], T[i]) for i in (slice(1), slice(1, 2), slice(2, None))
    )
    return f"off at q = 0 by {zero}, at home by {home}, elsewhere by up to {other}"


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
        f"Two things: {first.says}; and {second.says}. (Differs from the right answer "
        f"by up to {apart(S, T)}, from ours with both by 0.)",
    )
