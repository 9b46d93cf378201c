"""Where along a serial chain a product of poses goes wrong.

The right product, cut before or after a factor, is A @ F @ B. If the student's pose is
A @ X @ B, then all but that place is right, and X is what stands in F's place. Any task
that multiplies along an arm can use it: link and joint factors, or exponentials.
"""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from functools import reduce
from itertools import accumulate
from typing import Any

import numpy as np

from labkit.judge.answers import difference, matches
from labkit.judge.matrices import rigid_inverse
from labkit.judge.mistake import Finding
from labkit.judge.rigid_kinds import Pose
from robo47.checks import Array

STEADY = 1e-5  # how far a constant may wander: a student's float32
ALONE = "Without this mistake, the error is 0."
NEAR = 1e-4


@dataclass(frozen=True)
class Factor:
    """One factor of a product."""

    place: str  # what it is called, "link5", after "the step to"
    T: Array  # the right factor at every question, (n, 4, 4)
    fixed: bool  # whether it is the same at every q
    # What else may stand there: findings (a clause without full stop), each with the
    # factor that it makes, (n, 4, 4).
    candidates: Callable[[], Iterable[tuple[Finding, Array]]] = tuple
    # What to say of any other factor found in its place, or None.
    unnamed: Callable[[Array], Finding | None] | None = None


def product(factors: Iterable[Array], n: int) -> Array:
    """Return the factors multiplied from left to right, (n, 4, 4)."""
    return np.broadcast_to(reduce(np.matmul, factors, np.eye(4)), (n, 4, 4))


def steady(X: Array) -> bool:
    """Return whether X, (n, 4, 4), is the same at every q."""
    return float(np.abs(X - X[0]).max()) < STEADY


def one_place(S: Array, T: Array, factors: Sequence[Factor]) -> Finding | None:
    """Return which single factor is wrong, if one alone explains every answer.

    Args:
        S: the student's poses, rigid, (n, 4, 4).
        T: the right ones.
        factors: whose product T is.
    """
    rest = f"{Pose().largest_error(S, T)} {ALONE}"
    found = list(_in_place_of(S, factors))
    for factor, X in found:
        if factor.fixed and not steady(X):
            continue
        for finding, again in factor.candidates():
            if matches(X, np.broadcast_to(again, X.shape)):
                return Finding(finding.slug, f"{finding.message}. {rest}")
    if fixed := [(f, X) for f, X in found if f.fixed and steady(X)]:
        # A constant along a joint's own axis fits before it and after it: say both.
        names = " or to ".join(factor.place for factor, _ in fixed)
        off = Pose().apart(fixed[0][1][:1], fixed[0][0].T[:1])
        return Finding(
            "one-link-off",
            f"Your fixed transform to {names} is wrong by {off} at every q. {ALONE}",
        )
    for factor, X in found:
        if factor.unnamed and (wrong := factor.unnamed(X)):
            return Finding(wrong.slug, f"{wrong.message}. {rest}")
    return None


def first_wrong(
    names: Sequence[str], given: Sequence[Any], right: Sequence[Array]
) -> str:
    """Return from which prefix of the chain on the student is wrong, in a sentence.

    Args:
        names: what each prefix ends in, from the world outwards.
        given: the student's pose for each, or None where there is no answer.
        right: the right ones, (4, 4) each.

    Returns:
        "" where nothing is to be said: an answer is missing, or none is wrong.
    """
    off = []
    for pose, T in zip(given, right, strict=True):
        if not isinstance(pose, np.ndarray) or pose.shape != (4, 4):
            return ""
        off.append(difference(pose[None].astype(np.float64), T[None])[0] > NEAR)
    if not any(off):
        return ""
    k = int(np.argmax(off))
    if k == 0:
        return f"The result is already wrong for the path that ends in {names[0]}."
    return (
        f"For shorter paths, the result is right up to {names[k - 1]}. The step to "
        f"{names[k]} is the first wrong step."
    )


def _in_place_of(S: Array, factors: Sequence[Factor]) -> Iterable[tuple[Factor, Array]]:
    """Yield per factor what the student has in its place, (n, 4, 4)."""
    Ts = [factor.T for factor in factors]
    none = np.broadcast_to(np.eye(4), S.shape)
    before = accumulate(Ts, initial=none, func=np.matmul)
    after = accumulate(Ts[:0:-1], initial=none, func=lambda rest, T: T @ rest)
    for factor, A, B in zip(factors, before, [*after][::-1], strict=False):
        yield factor, rigid_inverse(A) @ S @ rigid_inverse(B)
