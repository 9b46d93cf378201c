"""One mistake that is only a part of what is wrong.

It is claimed where made on purpose it explains a result of several, or the answers to
some calls, which are counted.
"""

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from labkit.judge.answers import (
    Parts,
    capitalised,
    gaps,
    in_calls,
    is_or_are,
    listed,
)
from labkit.judge.hypothesis import equals
from labkit.judge.matcher import Calls, Matcher
from labkit.judge.mistake import Finding, Mistake, as_sentence
from labkit.judge.pairs import of_its_own_first

FEW = 6  # wrong calls at which one mistake is tried, before all of them
SOME = 3  # calls whose numbers it has to give, at least, and half of the wrong ones


def by_results(m: Matcher) -> Finding | None:
    """Return the named mistakes that give wrong results of a function of several.

    What is with the other results is said besides: a mistake of one may be about all.
    """
    wrong = _wrong_results(m)
    # Of counts and truth values, equal ones prove little.
    numbers = [j for j in wrong if not m.ask.kinds[j].whole]
    if len(wrong) < 2 or not numbers:
        return None
    told: dict[int, Mistake] = {}
    for one in of_its_own_first(m):
        left = [j for j in numbers if j not in told]
        told |= dict.fromkeys(_given_by(m, one, left), one)
    if not told:
        return None
    says = [*_each_mistake(m, told), _of_the_others(m, told)]
    slug = "+".join(dict.fromkeys(one.slug for one in told.values()))
    return Finding(
        slug + "+other" * (len(told) < len(wrong)), " ".join(filter(None, says))
    )


def _given_by(m: Matcher, one: Mistake, left: list[int]) -> list[int]:
    """Return which of some wrong results a mistake gives in every call."""
    answer = m.main.answer(one.redo, m.furthest)
    if len(answer) != len(m.S):
        return []
    mine = tuple(s[m.furthest] for s in m.S)
    fits = m.main.difference.fits
    some = [j for j in left if fits(m.furthest, _put(mine, answer, j))]
    for calls in filter(None, (m.main, m.fresh)) if some else ():
        every = calls.answers(one.redo)
        if not every or _spoils(calls, every):
            return []
        some = [j for j in some if _gives(calls, every, j)]
    return some


def _spoils(calls: Calls, every: Parts) -> bool:
    """Return whether a mistake makes a result wrong that the student has right.

    Its sentence is about that result as well, and so it would be false.
    """
    ask, S, T = calls.ask, calls.S, calls.T
    return any(
        (ask.gaps_of(j, S[j], T[j]) <= ask.near).all()
        and (ask.gaps_of(j, every[j], T[j]) > ask.near).any()
        for j in range(len(S))
    )


def _gives(calls: Calls, every: Parts, j: int) -> bool:
    """Return whether answers have the j-th result of all calls, and a wrong one."""
    kind, near = calls.ask.kinds[j], calls.ask.near
    differs = gaps([kind], (every[j],), (calls.T[j],)).max() > near
    exact = equals([kind], (calls.S[j],), (every[j],))  # one result says little
    again = _put(calls.S, every, j)
    return differs and exact and bool(calls.difference.explained(again).all())


def _each_mistake(m: Matcher, told: Mapping[int, Mistake]) -> Iterator[str]:
    """Yield what may explain each: "One mistake would explain the mask: your ..."."""
    first = "One mistake"
    for one in dict.fromkeys(told.values()):
        names = [_name(m, j) for j in sorted(told) if told[j] is one]
        yield f"{first} would explain {listed(names)}: {as_sentence(one.says)}"
        first = "Another mistake"


def _of_the_others(m: Matcher, told: Mapping[int, Mistake]) -> str:
    """Return which other results are right, and which are wrong, too."""
    sets = [one for one in (m.main, m.fresh) if one]
    off = {
        j: [m.ask.gaps_of(j, one.S[j], one.T[j]) > m.ask.near for one in sets]
        for j in range(len(m.S))
        if j not in told
    }
    right = [_name(m, j) for j in off if not np.any(np.concatenate(off[j]))]
    says = []
    if right:
        verb = is_or_are(right)
        says.append(f"{capitalised(listed(right))} {verb} correct.")
    for j in off:
        if n := int(np.sum(off[j][0])):
            often = in_calls(n, len(off[j][0]))
            name = _name(m, j)
            says.append(f"{capitalised(name)} {is_or_are([name])} wrong {often}, too.")
    return " ".join(says)


def _name(m: Matcher, j: int) -> str:
    return m.ask.kinds[j].called or f"result {j + 1}"


def _wrong_results(m: Matcher) -> list[int]:
    trios = enumerate(zip(m.ask.kinds, m.S, m.T, strict=True))
    return [j for j, (k, s, t) in trios if gaps([k], (s,), (t,)).max() > m.ask.near]


def _put(some: Parts, other: Parts, j: int) -> Parts:
    return (*some[:j], other[j], *some[j + 1 :])


def in_some_calls(m: Matcher) -> Finding | None:
    """Return the named mistake that gives the answers of half of the wrong calls.

    It is said of these alone: another one may give the same numbers there. Numbers that
    are 0, or all the same, prove no mistake.
    """
    least = max(SOME, -(-len(m.wrong) // 2))
    if m.whole or len(m.wrong) <= least:
        return None
    few = m.wrong[np.unique(np.linspace(0, len(m.wrong) - 1, FEW).astype(int))]
    most: tuple[int, int, Mistake] | None = None
    for one in of_its_own_first(m):
        fits = m.main.difference.fits
        if sum(fits(i, m.main.answer(one.redo, i)) for i in few.tolist()) < 2:
            continue
        n, every = _given_in(m, one, least)
        if every / 2 <= n < every and (most is None or n > most[0]):
            most = n, every, one
    if most is None:
        return None
    n, every, one = most
    rest = "other wrong call" if every - n == 1 else f"other {every - n} wrong calls"
    says = (
        f"One mistake would explain the result in {n} of the {every} wrong calls: "
        f"{as_sentence(one.says)} In the {rest}, the reference solution with this "
        "mistake gives a different result."
    )
    return Finding(f"{one.slug}+other", says)


def _given_in(m: Matcher, one: Mistake, least: int) -> tuple[int, int]:
    """Return how many wrong answers a mistake gives, and how many there are.

    It gives none if the main calls have too few of them, or if it would show in one
    that is right. A fresh call may refute what gives all the others.
    """
    n, every = 0, 0
    for calls in filter(None, (m.main, m.fresh)):
        given = calls.difference.explained(calls.answers(one.redo)).astype(bool)
        off = m.ask.gaps(calls.S, calls.T) > m.ask.near
        which = np.flatnonzero(given & off)
        few = calls is m.main and not (len(which) >= least and _differ(m.S, which))
        if few or not given[~off].all():
            return 0, int(off.sum()) + every
        n, every = n + len(which), every + int(off.sum())
    return n, every


def _differ(S: Parts, which: Any) -> bool:
    """Return whether answers to some calls are not all the same, nor 0."""
    if len(which) < SOME:
        return False
    some = [s[which].reshape(len(which), -1) for s in S]
    flat = np.concatenate(some, axis=1)
    flat = flat[flat.any(axis=1)]
    return len(flat) >= SOME and bool(np.ptp(flat, axis=0).max() > 1e-6)
