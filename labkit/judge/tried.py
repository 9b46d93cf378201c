"""Sentences about all answers, held against the fresh ones as well.

"All entries are right but [0, 2]" is read from the main questions. It is said only if
the fresh ones, which were asked in the same round, would be told the same.
"""

import re
from typing import Any

import numpy as np

from labkit.judge import near_miss
from labkit.judge.answers import Parts, as_one, say_error
from labkit.judge.ask import Case
from labkit.judge.mistake import Finding
from robo47.checks import Array

# What must be the same; any other number may grow with more inputs.
_KEPT = re.compile(r"(\[[^\]]*\]|\b(?:joint|rows?|columns?|link) ?\d+(?: to \d+)?)")
# Of answers that are nearly right only what tells the wrong entries, or all of them,
# exactly: whether R is a rotation, say, follows from a rounded constant.
_EXACT = {
    "few-entries-off", "one-factor-off", "shifted", "part-off", "translation-off",
    "first-half-off", "second-half-off",
}  # fmt: skip
# Where all that is wrong stands is said of all answers, fresh ones as well.
_OF_ALL = {"part-off", "few-entries-off"}
_NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:e[+-]?\d+)?")


def what_is_wrong(case: Case, S: Parts, T: Parts, i: int) -> Finding:
    """Return what is wrong with a part of the answers, where it is so at all inputs.

    Args:
        case: what was asked; S, T: the answers, as parts.
        i: which part.
    """
    kind = case.ask.kinds[i]
    first = _shown_first(case, len(S[i])) if kind.whole else slice(None)
    found = kind.what_is_wrong(S[i][first], T[i][first])
    plain = Finding("off", say_error(kind.apart(S[i], T[i])))
    if near_miss.about_right(S[i], T[i]) and found.slug not in _EXACT:
        return plain
    if case.further is None:
        return found
    try:
        wider = kind.what_is_wrong(*_with_further(case, S, T, i))
    except ValueError:  # of other sizes than a kind takes
        return plain
    if wider.slug in _OF_ALL:
        return wider
    return found if _form(found.message) == _form(wider.message) else plain


def _shown_first(case: Case, n: int) -> Any:
    """Return the order of n calls in which the failing call that is shown is first.

    A kind of counts or choices gives the numbers of its first wrong call.
    """
    rest = np.ones(n, bool) if case.failing is None else ~case.failing
    return np.argsort(rest, kind="stable")


def in_common(case: Case, S: Parts, T: Parts, i: int) -> str:
    """Return what all wrong answers share with the right ones, or ""."""
    if case.ask.kinds[i].gap == "wrong in":
        return ""  # words and truth values have no size
    found = near_miss.in_common(S[i], T[i])
    if case.further is None or not found:
        return found
    wider = near_miss.in_common(*_with_further(case, S, T, i))
    if wider == near_miss.LARGEST + near_miss.WHY and near_miss.EACH in found:
        return wider  # it is true of all
    return wider if _form(wider) == _form(found) else ""


def _with_further(case: Case, S: Parts, T: Parts, i: int) -> tuple[Array, Array]:
    assert case.further is not None
    mine = as_one([*S[i], *case.further.S[i]])
    its = as_one([*T[i], *case.further.T[i]])
    return mine, its


def _form(message: str) -> str:
    """Return a sentence without the numbers that say how much."""
    parts = _KEPT.split(message)
    return "".join(p if k % 2 else _NUMBER.sub("#", p) for k, p in enumerate(parts))
