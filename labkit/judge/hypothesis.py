"""When a hypothesis, "your code does X", explains a student's answers.

A hypothesis explains the difference between the student's answers and the right ones,
not the answers: a matrix that is symmetric equals its transpose, so the transpose says
nothing about what is wrong with it. At every call, what the hypothesis leaves
unexplained has to be below a hundredth of that difference.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from labkit.judge.answers import MATCHES, Parts, difference, gap
from robo47.checks import Array

SHARE = 0.01  # of the difference from the right answer, which may stay unexplained
# Of the largest number: what the order of a sum's terms changes. Of many mutants and
# pairs one comes near by chance, so these have to give as many digits.
EXACT = 1e-9
# Times the largest number of the right answer: what a division by almost zero leaves.
# The sum of other rounding errors decides whether it is huge, infinite or NaN.
LOST = 1e10


@dataclass(frozen=True, eq=False)
class Difference:
    """A student's answers beside the right ones: what explains the difference?"""

    ask: Any  # the row, which says what is near enough to the right answer
    S: Parts  # the student's, (n, ...) per result
    T: Parts  # the right ones

    @cached_property
    def given(self) -> Parts:
        """The student's answers, NaN where a division by almost zero has lost them."""
        return tuple(map(lost_as_nan, self.S, self.T))

    @cached_property
    def limits(self) -> list[Array]:
        """How far a hypothesis may be from the student's answer, (n,) per result."""
        found = []
        for kind, s, t in zip(self.ask.kinds, self.given, self.T, strict=True):
            off = difference(s, t, kind.scale)
            size = np.maximum(1.0, _sizes(s, kind.scale))
            free = self.ask.rtol * _sizes(t, kind.scale) + self.ask.near
            # Where the answer is right, or where it is no number, digits are compared.
            wrong = np.isfinite(off) & (off > free)
            found.append(np.where(wrong, SHARE * off, np.maximum(MATCHES * size, free)))
        return found

    @cached_property
    def digits(self) -> list[Array]:
        """The same where every digit is compared that rounding leaves."""
        trios = zip(self.limits, self.given, self.ask.kinds, strict=True)
        return [
            np.minimum(some, EXACT * np.maximum(1.0, _sizes(s, k.scale).max(initial=0)))
            for some, s, k in trios
        ]

    def free(self, i: int) -> Array:
        """Return how far each number of the answer to one call may be off, as a row."""
        trios = zip(self.digits, self.S, self.ask.kinds, strict=True)
        some = [np.broadcast_to(x[i] * k.scale, s.shape[1:]) for x, s, k in trios]
        return np.concatenate([np.ravel(x) for x in some])

    def fits(self, i: int, H: Parts, digits: bool = False) -> bool:
        """Return whether a hypothesis explains the answer to one call.

        Args:
            i: which call.
            H: the answer that the hypothesis gives, the parts of one call.
            digits: whether every digit is compared.
        """
        if len(H) != len(self.S):
            return False
        limits = self.digits if digits else self.limits
        rows = zip(H, self.given, self.T, limits, self.ask.kinds, strict=True)
        return all(
            h.shape == s.shape[1:]
            and _within(lost_as_nan(h[None], t[[i]])[0], s[i], some[i], kind.scale)
            for h, s, t, some, kind in rows
        )

    def explained(self, H: Parts) -> Array:
        """Return of each call whether a hypothesis explains its difference, (n,)."""
        n = len(self.S[0])
        pairs = zip(H, self.S, strict=False)
        if len(H) != len(self.S) or any(h.shape != s.shape for h, s in pairs):
            return np.zeros(n, bool)
        good = np.ones(n, bool)
        H = tuple(map(lost_as_nan, H, self.T))
        trios = zip(H, self.given, self.limits, self.ask.kinds, strict=True)
        for h, s, limit, kind in trios:
            good &= difference(h, s, kind.scale) <= limit
        return good

    def explains(self, H: Parts) -> bool:
        """Return whether a hypothesis explains every call, and says what is wrong."""
        return bool(self.explained(H).all()) and self.differs(H)

    def equals(self, H: Parts) -> bool:
        """Return whether a hypothesis gives all numbers, to what rounding leaves."""
        if len(H) != len(self.T):
            return False
        return equals(self.ask.kinds, self.given, tuple(map(lost_as_nan, H, self.T)))

    def differs(self, H: Parts) -> bool:
        """Return whether a hypothesis gives other answers than the right ones.

        It has to do so in every result that is wrong, at the call that is furthest off.
        """
        H = tuple(map(lost_as_nan, H, self.T))
        trios = zip(self.ask.kinds, self.given, self.T, H, strict=True)
        for j, (kind, s, t, h) in enumerate(trios):
            off = self.ask.gaps_of(j, s, t)
            if off.max(initial=0.0) <= self.ask.near:
                continue
            i = int(np.argmax(off))
            apart = difference(h[i : i + 1], t[i : i + 1], kind.scale)[0]
            if apart < (1.0 - SHARE) * min(off[i], 1e300):
                return False
        return True


def lost_as_nan(some: Array, right: Array) -> Array:
    """Return answers with NaN where a division by almost zero has lost an entry.

    Args:
        some: answers, (n, ...).
        right: the right ones, of which an entry may be infinite and is kept then.
    """
    if some.shape != right.shape:
        return some
    size = LOST * np.maximum(1.0, _sizes(right, 1.0))
    size = size.reshape(-1, *[1] * (some.ndim - 1))
    with np.errstate(invalid="ignore"):
        lost = np.isfinite(right) & ~(np.abs(some) <= size)
    return np.where(lost, np.nan, some)


def equals(kinds: Sequence[Any], S: Parts, H: Parts) -> bool:
    """Return whether two sets of answers are equal but for the order of a sum."""
    pairs = zip(S, H, kinds, strict=False)
    return len(S) == len(H) and all(_equals(s, h, kind.scale) for s, h, kind in pairs)


def _equals(s: Array, h: Array, scale: Any) -> bool:
    if s.shape != h.shape:
        return False
    size = max(1.0, float(_sizes(s, scale).max(initial=0.0)))
    return bool(difference(h, s, scale).max(initial=0.0) <= EXACT * size)


def evidence(exact: bool) -> str:
    """Return what a hypothesis does, after what it is: "its transpose ..."."""
    if exact:
        return "gives the same output as your code"
    return "gives at least 99 % of your error in every call"


def _within(h: Array, s: Array, limit: float, scale: Any) -> bool:
    if h.shape != s.shape:
        return False
    if not h.size:
        return True
    off = float((np.abs(h - s) / scale).max())
    if off <= limit:
        return True
    return not np.isfinite(off) and bool((gap(h, s) / scale).max() <= limit)


def _sizes(x: Array, scale: Any) -> Array:
    """Return the largest finite entry of each answer, in units of a scale, (n,)."""
    sizes = np.abs(x / np.asarray(scale))
    sizes = np.where(np.isfinite(sizes), sizes, 0.0)
    return sizes.reshape(len(x), -1).max(axis=1, initial=0.0)
