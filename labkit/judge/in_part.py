"""One mistake that is only a part of what is wrong.

It is claimed where made on purpose it explains a result of several, or the answers to
some calls, which are counted.
"""

from typing import Any

import numpy as np

from labkit.judge.answers import Parts, capitalised, gaps
from labkit.judge.hypothesis import equals
from labkit.judge.matcher import Matcher
from labkit.judge.mistake import Finding, Mistake
from labkit.judge.pairs import of_its_own_first

FEW = 6  # wrong calls at which one mistake is tried, before all of them
SOME = 3  # calls whose numbers it has to give, at least, and half of the wrong ones


def by_results(m: Matcher) -> Finding | None:
    """Return a named mistake for each wrong result of a function that returns several.

    One that has none of its own is said to be wrong besides.
    """
    kinds, wrong = m.ask.kinds, _wrong_results(m)
    if len(wrong) < 2 or m.whole:
        return None
    told: dict[int, Mistake] = {}
    for one in of_its_own_first(m):
        answer = m.main.answer(one.redo, m.furthest)
        left = [j for j in wrong if j not in told and len(answer) == len(m.S)]
        mine = tuple(s[m.furthest] for s in m.S)
        some = [
            j for j in left if m.main.difference.fits(m.furthest, _put(mine, answer, j))
        ]
        every = m.main.answers(one.redo) if some else ()
        for j in some if every else ():
            again = _put(m.S, every, j)
            differs = gaps([kinds[j]], (every[j],), (m.T[j],)).max() > m.ask.near
            exact = equals([kinds[j]], (m.S[j],), (every[j],))  # one result says little
            if differs and exact and m.main.difference.explained(again).all():
                told[j] = one
    if not told:
        return None
    says = [
        f"{capitalised(kinds[j].called or f'result {j + 1}')}: "
        + (
            f"{told[j].says.rstrip('?')}."
            if j in told
            else "this result is wrong, too."
        )
        for j in sorted(wrong, key=lambda j: j not in told)
    ]
    slug = "+".join(dict.fromkeys(one.slug for one in told.values()))
    return Finding(slug + "+other" * (len(told) < len(wrong)), " ".join(says))


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
    wrong = m.wrong
    least = max(SOME, -(-len(wrong) // 2))
    if m.whole or len(wrong) <= least:
        return None
    few = wrong[np.unique(np.linspace(0, len(wrong) - 1, FEW).astype(int))]
    most: tuple[int, Mistake] | None = None
    for one in of_its_own_first(m):
        fits = m.main.difference.fits
        if sum(fits(i, m.main.answer(one.redo, i)) for i in few.tolist()) < 2:
            continue
        given = m.main.difference.explained(m.main.answers(one.redo))
        n = int(np.sum(given[wrong])) if _differ(m.S, wrong[given[wrong]]) else 0
        # Made every time, it shows nowhere that is right.
        always = given[m.ask.gaps(m.S, m.T) <= m.ask.near].all()
        if always and least <= n < len(wrong) and (most is None or n > most[0]):
            most = n, one
    if most is None:
        return None
    n, one = most
    others = len(wrong) - n
    rest = "This mistake does not explain the other "
    rest += "one" if others == 1 else str(others)
    says = (
        f"One mistake explains {n} of your {len(wrong)} wrong answers: "
        f"{one.says.rstrip('?')}. {rest}."
    )
    return Finding(f"{one.slug}+other", says)


def _differ(S: Parts, which: Any) -> bool:
    """Return whether answers to some calls are not all the same, nor 0."""
    if len(which) < SOME:
        return False
    some = [s[which].reshape(len(which), -1) for s in S]
    flat = np.concatenate(some, axis=1)
    flat = flat[flat.any(axis=1)]
    return len(flat) >= SOME and bool(np.ptp(flat, axis=0).max() > 1e-6)
