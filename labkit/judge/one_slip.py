"""Slips that nobody named: the lab's own body with one place of it changed.

One is claimed where it gives all of the student's numbers, fresh ones as well; two, or
one beside a named mistake, where their differences from the right answers add up to it.
"""

from collections.abc import Callable, Iterator, Sequence
from functools import partial
from itertools import islice
from typing import Any, NamedTuple

import numpy as np

from labkit.judge.answers import InTurn, Parts, capitalised, worst_part
from labkit.judge.ask import SLIPPING, Case
from labkit.judge.mistake import Finding
from labkit.judge.miswritten import SAYS, Miswritten, besides, overlap, rank, reads
from labkit.judge.pairs import (
    QUICK,
    answer_to,
    answers_to,
    exactly,
    nth,
    of_its_own_first,
    tried,
)
from robo47.checks import Array

FEW = 3  # wrong calls at which the first of two slips is looked for
LIKELY = 3  # first slips beside which all others are tried
MOST = 400  # pairs that add up at one call, of which some do at all
NAMED = 1.5  # a named mistake comes after two signs, and before the other slips
# Slips that may be one of two: by factors and numbers a sum is made in too many ways.
ALONG = {"sign", "negated", "left-out", "name", "order", "transpose", "index", "line"}
CLOSE = 1e-9  # of the largest number: two that are projected alike may be alike


def one_slip(case: Case, S: Parts, T: Parts) -> Finding | None:
    """Return which slip in the lab's own function gives the answers, or None."""
    if not _may_slip(case):
        return None
    i = tried(case.ask, S, T)[0]
    mine = nth(S, i)
    for one in case.ask.miswritten:
        redo = case.ask.in_turn(one.code)
        here = exactly(case.ask, answer_to(redo, case.arguments, i, T), mine)
        if here and _gives_all(case, partial(answers_to, redo), S):
            return _told(case, [_of(case, one)], S, T)
    return None


def _may_slip(case: Case) -> bool:
    ask = case.ask
    return not any(kind.whole for kind in ask.kinds) and ask.seconds <= QUICK


def _gives_all(
    case: Case, answers: Callable[[tuple[Any, ...]], Parts], S: Parts
) -> bool:
    """Return whether mistakes give all answers, those to the fresh questions too."""
    if not exactly(case.ask, answers(case.arguments), S):
        return False
    more = case.further
    return not more or exactly(case.ask, answers(more.arguments), more.S)


class _Part(NamedTuple):
    """A slip or a named mistake, as one of two."""

    slug: str
    says: str
    redo: InTurn
    slip: Miswritten | None = None


def slip_beside(case: Case, S: Parts, T: Parts) -> Finding | None:
    """Return two slips, or one and a named mistake, that add up to the answers."""
    if not _may_slip(case):
        return None
    i = tried(case.ask, S, T)[0]
    every = list(_all_parts(case))
    answers = [answer_to(one.redo, case.arguments, i, T) for one in every]
    its = _row(nth(T, i))
    rows = {k: _row(a) for k, a in enumerate(answers)}
    known = [k for k, r in rows.items() if r.shape == its.shape and _tells(r, its)]
    if not known:
        return None
    off = np.array([rows[k] for k in known]) - its
    sums = _sums(off, _row(nth(S, i)) - its)
    pairs = [(every[known[a]], every[known[b]]) for a, b in islice(sums, MOST)]
    for pair in sorted(pairs, key=lambda some: sum(map(_rank, some))):
        if _apart(*pair) and _gives_all(case, _together(case, *pair), S):
            return _told(case, pair, S, T)
    return None


def two_slips(case: Case, S: Parts, T: Parts) -> Finding | None:
    """Return two slips of which the second works on what the first made, or None.

    The first is one that gives more of the student's numbers than the right ones do.
    Of a slow function they are not looked for.
    """
    if not _may_slip(case) or not (body := case.ask.body()):
        return None
    if len(case.ask.miswritten) * case.ask.labs_cost * (FEW + LIKELY) > SLIPPING:
        return None
    i = tried(case.ask, S, T)[0]
    mine = nth(S, i)
    for first in _likely(case, S, T):
        for other in besides(*body, first)[: len(case.ask.miswritten)]:
            redo = case.ask.in_turn(other.code)
            if not exactly(case.ask, answer_to(redo, case.arguments, i, T), mine):
                continue
            if _gives_all(case, partial(answers_to, redo), S):
                pair = [_of(case, first), _of(case, other)]
                return _told(case, pair, S, T, first)
    return None


def _likely(case: Case, S: Parts, T: Parts) -> list[Miswritten]:
    """Return the slips that give most numbers of a few wrong answers."""
    wrong = np.flatnonzero(case.ask.gaps(S, T) > case.ask.near)
    few = wrong[np.unique(np.linspace(0, len(wrong) - 1, FEW).astype(int))]

    def given(answers: Sequence[Parts]) -> int:
        pairs = zip(map(_row, answers), (_row(nth(S, i)) for i in few), strict=True)
        return sum(
            int(np.isclose(a, s, CLOSE, CLOSE).sum())
            for a, s in pairs
            if a.shape == s.shape
        )

    scores = []
    for one in case.ask.miswritten:
        redo = case.ask.in_turn(one.code)
        scores.append(given([answer_to(redo, case.arguments, i, T) for i in few]))
    least = given([nth(T, i) for i in few])
    best = sorted(range(len(scores)), key=lambda k: -scores[k])[:LIKELY]
    return [case.ask.miswritten[k] for k in best if scores[k] > least]


def _of(case: Case, slip: Miswritten) -> "_Part":
    redo = case.ask.in_turn(slip.code)
    return _Part(f"slip-{slip.kind}", SAYS[slip.kind], redo, slip)


def _rank(part: "_Part") -> float:
    return rank(part.slip) if part.slip else NAMED


def _all_parts(case: Case) -> Iterator[_Part]:
    for named in of_its_own_first(case.ask):
        assert isinstance(named.redo, InTurn)
        yield _Part(named.slug, named.says.rstrip("?"), named.redo)
    for one in case.ask.miswritten:
        if one.kind in ALONG:
            yield _of(case, one)


def _row(answer: Parts) -> Array:
    return np.concatenate([np.ravel(x) for x in answer]) if answer else np.empty(0)


def _tells(row: Array, its: Array) -> bool:
    return bool(np.isfinite(row).all() and np.abs(row - its).max(initial=0.0) > CLOSE)


def _sums(off: Array, wanted: Array) -> Iterator[tuple[int, int]]:
    """Yield pairs of rows of off, (n, m), whose sum is the wanted row."""
    if not np.isfinite(wanted).all():
        return
    onto = np.random.default_rng(len(wanted)).uniform(0.5, 1.5, len(wanted))
    shadow = off @ onto
    order = np.argsort(shadow)
    near = CLOSE * max(1.0, float(np.abs(off).max()))
    low = np.searchsorted(shadow[order], wanted @ onto - shadow - near)
    high = np.searchsorted(shadow[order], wanted @ onto - shadow + near)
    for a in range(len(off)):
        for b in sorted(order[low[a] : high[a]]):
            if b > a and np.abs(off[a] + off[b] - wanted).max() <= near:
                yield a, int(b)


def _apart(one: _Part, other: _Part) -> bool:
    """Return whether two are of two places, and not both named: those were tried."""
    if one.slip and other.slip:
        return not overlap(one.slip, other.slip)
    return bool(one.slip or other.slip)


def _together(
    case: Case, one: _Part, other: _Part
) -> Callable[[tuple[Any, ...]], Parts]:
    truth = case.ask.truth
    assert truth

    def answers(arguments: tuple[Any, ...]) -> Parts:
        trio = [answers_to(f, arguments) for f in (one.redo, other.redo, truth)]
        if len({tuple(x.shape for x in some) for some in trio}) > 1:
            return ()
        return tuple(x + y - z for x, y, z in zip(*trio, strict=True))

    return answers


def _told(
    case: Case,
    found: Sequence[_Part],
    S: Parts,
    T: Parts,
    first: Miswritten | None = None,
) -> Finding:
    ask = case.ask
    k = worst_part(ask.kinds, S, T, ask.near)
    off = f"Off by up to {ask.kinds[k].apart(S[k], T[k])}"
    body = ask.body()
    assert body
    befores = [None, first]  # a second slip may be one of what the first made
    pairs = zip(found, befores, strict=False)
    texts = [reads(body[0], p.slip, after) if p.slip else "" for p, after in pairs]
    slug = "+".join(one.slug for one in found)
    if len(found) == 1:
        how = f"`{texts[0]}`" if texts[0] else "that slip"
        says = f"{capitalised(found[0].says)}. ({off}; the lab's own with {how} gives"
        return Finding(slug, f"{says} your numbers exactly.)")
    both = zip(found, texts, strict=True)
    says = "; ".join(f"{p.says} (as in `{t}`)" if t else p.says for p, t in both)
    how = f"{off}; both together give your numbers exactly"
    return Finding(slug, f"Two things at once: {says}. ({how}.)")
