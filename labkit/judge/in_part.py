"""One mistake that is only a part of what is wrong.

It is claimed where made on purpose it gives a result of several, or the numbers of some
calls, which are counted.
"""

from typing import Any

import numpy as np

from labkit.judge.answers import (
    Parts,
    capitalised,
    gaps,
    matches,
)
from labkit.judge.ask import Case
from labkit.judge.hypothesis import explained
from labkit.judge.mistake import Finding, Mistake
from labkit.judge.pairs import alike, answer_to, answers_to, nth, of_its_own_first

FEW = 6  # wrong calls at which one mistake is tried, before all of them
SOME = 3  # calls whose numbers it has to give, at least, and half of the wrong ones


def by_results(case: Case, S: Parts, T: Parts) -> Finding | None:
    """Return a named mistake for each wrong result of a function that returns several.

    One that has none of its own is said to be wrong besides.
    """
    ask = case.ask
    pairs = list(zip(ask.kinds, S, T, strict=True))
    wrong = [
        j
        for j, (kind, s, t) in enumerate(pairs)
        if gaps([kind], (s,), (t,)).max() > ask.near
    ]
    if len(wrong) < 2 or any(kind.whole for kind in ask.kinds):
        return None
    i = int(np.argmax(ask.gaps(S, T)))
    told: dict[int, Mistake] = {}
    for one in of_its_own_first(ask):
        answer = answer_to(one.redo, case.arguments, i, T)
        for j in [j for j in wrong if j not in told and len(answer) == len(S)]:
            kind, s, t = pairs[j]
            if not matches(s[i : i + 1], answer[j], kind.scale):
                continue
            every = answers_to(one.redo, case.arguments)
            if len(every) != len(S):
                continue
            its = (*S[:j], every[j], *S[j + 1 :])
            is_wrong = gaps([kind], (every[j],), (t,)).max() > ask.near
            if is_wrong and explained(ask, S, T, its).all():
                told[j] = one
    if not told:
        return None
    says = [
        f"{capitalised(ask.kinds[j].called or f'result {j + 1}')}: "
        + (f"{told[j].says.rstrip('?')}." if j in told else "it is wrong, too.")
        for j in sorted(wrong, key=lambda j: j not in told)
    ]
    slug = "+".join(dict.fromkeys(one.slug for one in told.values()))
    return Finding(slug + "+other" * (len(told) < len(wrong)), " ".join(says))


def in_some_calls(case: Case, S: Parts, T: Parts) -> Finding | None:
    """Return the named mistake that gives the numbers of half of the wrong calls.

    It is said of these alone: another one may give the same numbers there. Numbers that
    are 0, or all the same, prove no mistake.
    """
    ask = case.ask
    wrong = np.flatnonzero(ask.gaps(S, T) > ask.near)
    least = max(SOME, -(-len(wrong) // 2))
    if any(kind.whole for kind in ask.kinds) or len(wrong) <= least:
        return None
    few = wrong[np.unique(np.linspace(0, len(wrong) - 1, FEW).astype(int))]
    most: tuple[int, Mistake] | None = None
    for one in of_its_own_first(ask):
        hits = [alike(ask, answer_to(one.redo, case.arguments, i, T), nth(S, i))
                for i in few]  # fmt: skip
        if sum(map(bool, hits)) < 2:
            continue
        given = explained(ask, S, T, answers_to(one.redo, case.arguments))
        n = int(np.sum(given[wrong])) if _differ(S, wrong[given[wrong]]) else 0
        # Made every time, it shows nowhere that is right.
        always = given[ask.gaps(S, T) <= ask.near].all()
        if always and least <= n < len(wrong) and (most is None or n > most[0]):
            most = n, one
    if most is None:
        return None
    n, one = most
    rest = "one is not" if len(wrong) == n + 1 else f"{len(wrong) - n} are not"
    says = (
        f"In {n} of your {len(wrong)} wrong answers the numbers are those of one "
        f"mistake: {one.says.rstrip('?')}. The other {rest}."
    )
    return Finding(f"{one.slug}+other", says)


def _differ(S: Parts, which: Any) -> bool:
    """Return whether answers to some calls are not all the same, nor 0."""
    if not len(which):
        return False
    some = [s[which].reshape(len(which), -1) for s in S]
    flat = np.concatenate(some, axis=1)
    flat = flat[flat.any(axis=1)]
    return len(flat) >= SOME and bool(np.ptp(flat, axis=0).max() > 1e-6)
