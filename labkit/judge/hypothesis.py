"""When a hypothesis, "your code does X", explains a student's answers.

A hypothesis explains the difference between the student's answers and the right ones,
not the answers: a matrix that is symmetric equals its transpose, so the transpose says
nothing about what is wrong with it. At every call, what the hypothesis leaves
unexplained has to be below a hundredth of that difference.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np

from labkit.judge.answers import MATCHES, Parts, difference
from robo47.checks import Array

SHARE = 0.01  # of the difference from the right answer, which may stay unexplained
# Of the largest number: what the order of a sum's terms changes. Of many mutants and
# pairs one comes near by chance, so these have to give as many digits.
EXACT = 1e-9


def explains(ask: Any, S: Parts, T: Parts, H: Parts) -> bool:
    """Return whether a hypothesis explains why answers differ from the right ones.

    Args:
        ask: the row, which says what is near enough to the right answer.
        S: the student's answers, (n, ...) per result.
        T: the right ones.
        H: the answers that the hypothesis gives.
    """
    good = explained(ask, S, T, H)
    return bool(good.all()) and _differs(ask, S, T, H)


def explained(ask: Any, S: Parts, T: Parts, H: Parts) -> Array:
    """Return of each call whether a hypothesis explains its difference, (n,)."""
    n = len(S[0]) if S else 0
    if len(H) != len(S) or any(h.shape != s.shape for h, s in zip(H, S, strict=True)):
        return np.zeros(n, bool)
    good = np.ones(n, bool)
    for kind, s, t, h in zip(ask.kinds, S, T, H, strict=True):
        off = difference(s, t, kind.scale)
        rest = difference(h, s, kind.scale)
        size = np.maximum(1.0, _sizes(s, kind.scale))
        free = ask.rtol * _sizes(t, kind.scale) + ask.near
        # Where the answer is right, or where it has no number, digits are compared.
        wrong = np.isfinite(off) & (off > free)
        good &= rest <= np.where(wrong, SHARE * off, np.maximum(MATCHES * size, free))
    return good


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
        return "gives your numbers exactly"
    return "explains at least 99 % of the difference in every call"


def _differs(ask: Any, S: Parts, T: Parts, H: Parts) -> bool:
    """Return whether a hypothesis gives another answer than the right one.

    It has to do so in every result that is wrong, at the call that is furthest off.
    """
    for j, (kind, s, t, h) in enumerate(zip(ask.kinds, S, T, H, strict=True)):
        off = ask.gaps_of(j, s, t)
        if off.max(initial=0.0) <= ask.near:
            continue
        i = int(np.argmax(off))
        one, its = h[i : i + 1], t[i : i + 1]
        if difference(one, its, kind.scale)[0] < (1.0 - SHARE) * min(off[i], 1e300):
            return False
    return True


def _sizes(x: Array, scale: Any) -> Array:
    """Return the largest finite entry of each answer, in units of a scale, (n,)."""
    sizes = np.abs(x / np.asarray(scale))
    sizes = np.where(np.isfinite(sizes), sizes, 0.0)
    return sizes.reshape(len(x), -1).max(axis=1, initial=0.0)
