"""Slips that nobody named: the lab's own body with one place of it changed.

One is claimed where it gives all of the student's numbers, fresh ones as well; two, or
one beside a named mistake, where their differences from the right answers add up to it.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property, partial
from itertools import islice
from typing import Any, NamedTuple

import numpy as np

from labkit.base.quiet import nothing_printed
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
SEVERAL = 20  # slips that give one answer, of which some give all
MOST = 400  # pairs that add up at one call, of which some do at all
NAMED = 1.5  # a named mistake comes after two signs, and before the other slips
# Slips that may be one of two: by factors and numbers a sum is made in too many ways.
ALONG = {"sign", "negated", "left-out", "name", "order", "transpose", "index", "line"}
CLOSE = 1e-9  # of the largest number: two that are projected alike may be alike


class _Part(NamedTuple):
    """A slip or a named mistake, as one of two."""

    slug: str
    says: str
    redo: InTurn
    slip: Miswritten | None = None


@dataclass(frozen=True)
class Slips:
    """The slips of the lab's own function beside a student's answers."""

    case: Case
    S: Parts  # the student's answers
    T: Parts  # the right ones

    @nothing_printed()
    def one(self) -> Finding | None:
        """Return which slip gives the answers, or which two do, each alone; or None."""
        answers = zip(self.some, self._answers, strict=True)
        here = (one for one, a in answers if exactly(self.case.ask, a, self._mine))
        found: list[Miswritten] = []
        for slip in islice(here, SEVERAL):
            apart = not any(overlap(slip, other) for other in found)
            if apart and self._gives_all(slip):
                found.append(slip)
        return self._told_of_one(found[:2]) if found else None

    @nothing_printed()
    def beside(self) -> Finding | None:
        """Return two slips, or one and a named mistake, that add up to the answers."""
        its = _row(nth(self.T, self._i))
        answered = [*self._named(), *self._slipped()]
        rows = [(part, _row(answer)) for part, answer in answered]
        known = [(part, row) for part, row in rows if _tells(row, its)]
        if not known:
            return None
        off = np.array([row for _, row in known]) - its
        sums = islice(_sums(off, _row(self._mine) - its), MOST)
        pairs = [(known[a][0], known[b][0]) for a, b in sums]
        for pair in sorted(pairs, key=lambda some: sum(map(_rank, some))):
            together = partial(self._together, *pair)
            if _apart(*pair) and _gives_all(self.case, together, self.S):
                return self._told(pair)
        return None

    @nothing_printed()
    def two(self) -> Finding | None:
        """Return two slips of which the second works on what the first made, or None.

        The first is one that gives more of the student's numbers than the right ones
        do. Of a slow function they are not looked for.
        """
        ask = self.case.ask
        calls = len(self.some) * (FEW + LIKELY)
        if not self.some or calls * ask.labs_cost > SLIPPING:
            return None
        body = ask.body()
        assert body
        for first in self._likely():
            for other in besides(*body, first):
                answer = self._answer(ask.in_turn(other.code))
                if exactly(ask, answer, self._mine) and self._gives_all(other):
                    return self._told([*map(self._part, (first, other))], first)
        return None

    @cached_property
    def some(self) -> list[Miswritten]:
        """The slips; none of whole numbers, of which many give the same."""
        ask = self.case.ask
        whole = any(kind.whole for kind in ask.kinds)
        return [] if whole or ask.seconds > QUICK else ask.miswritten

    @cached_property
    def _i(self) -> int:
        return tried(self.case.ask, self.S, self.T)[0]

    @property
    def _mine(self) -> Parts:
        return nth(self.S, self._i)

    @cached_property
    def _answers(self) -> list[Parts]:
        """The answers to one question, of every slip."""
        return [self._answer(self.case.ask.in_turn(one.code)) for one in self.some]

    def _answer(self, redo: InTurn, i: int | None = None) -> Parts:
        at = self._i if i is None else i
        return answer_to(redo, self.case.arguments, at, self.T)

    def _gives_all(self, slip: Miswritten) -> bool:
        redo = self.case.ask.in_turn(slip.code)
        return _gives_all(self.case, partial(answers_to, redo), self.S)

    def _named(self) -> Iterator[tuple[_Part, Parts]]:
        for one in of_its_own_first(self.case.ask) if self.some else []:
            assert isinstance(one.redo, InTurn)
            part = _Part(one.slug, one.says.rstrip("?"), one.redo)
            yield part, self._answer(one.redo)

    def _slipped(self) -> Iterator[tuple[_Part, Parts]]:
        for one, answer in zip(self.some, self._answers, strict=True):
            if one.kind in ALONG:
                yield self._part(one), answer

    def _part(self, slip: Miswritten) -> _Part:
        redo = self.case.ask.in_turn(slip.code)
        return _Part(f"slip-{slip.kind}", SAYS[slip.kind], redo, slip)

    def _together(self, one: _Part, other: _Part, arguments: tuple[Any, ...]) -> Parts:
        truth = self.case.ask.truth
        assert truth
        trio = [answers_to(f, arguments) for f in (one.redo, other.redo, truth)]
        if len({tuple(x.shape for x in some) for some in trio}) > 1:
            return ()
        return tuple(x + y - z for x, y, z in zip(*trio, strict=True))

    def _likely(self) -> list[Miswritten]:
        """Return the slips that give most numbers of a few wrong answers."""
        gap = self.case.ask.gaps(self.S, self.T)
        wrong = np.flatnonzero(gap > self.case.ask.near)
        few = wrong[np.unique(np.linspace(0, len(wrong) - 1, FEW).astype(int))]
        mine = [_row(nth(self.S, i)) for i in few]
        scores = []
        for one in self.some:
            redo = self.case.ask.in_turn(one.code)
            rows = [_row(self._answer(redo, i)) for i in few]
            scores.append(sum(map(_alike, rows, mine)))
        least = sum(
            _alike(_row(nth(self.T, i)), s) for i, s in zip(few, mine, strict=True)
        )
        best = sorted(range(len(scores)), key=lambda k: -scores[k])[:LIKELY]
        return [self.some[k] for k in best if scores[k] > least]

    def _off(self) -> str:
        kinds = self.case.ask.kinds
        k = worst_part(kinds, self.S, self.T, self.case.ask.near)
        return f"Off by up to {kinds[k].apart(self.S[k], self.T[k])}"

    def _told_of_one(self, found: Sequence[Miswritten]) -> Finding:
        """Return a slip, and another that gives the same numbers where there is one."""
        body = self.case.ask.body()
        assert body
        says = list(dict.fromkeys(SAYS[one.kind] for one in found))
        texts = [text for one in found if (text := reads(body[0], one))]
        own = ", or ".join(map(_with, texts)) or "with that slip"
        what = f"Either {', or '.join(says)}" if len(says) > 1 else capitalised(says[0])
        how = f"{self._off()}; the lab's own {own} reproduces your output"
        return Finding(f"slip-{found[0].kind}", f"{what}. ({how}.)")

    def _told(self, found: Sequence[_Part], first: Miswritten | None = None) -> Finding:
        body = self.case.ask.body()
        assert body
        befores = [None, first]  # a second slip may be one of what the first made
        pairs = zip(found, befores, strict=False)
        texts = [reads(body[0], p.slip, after) if p.slip else "" for p, after in pairs]
        slug = "+".join(one.slug for one in found)
        both = zip(found, texts, strict=True)
        says = "; ".join(f"{p.says} ({_with(t)})" if t else p.says for p, t in both)
        how = f"{self._off()}; both together reproduce your output"
        return Finding(slug, f"Two things at once: {says}. ({how}.)")


def _alike(one: Array, other: Array) -> int:
    """Return how many numbers of two answers are the same."""
    same = one.shape == other.shape
    return int(np.isclose(one, other, CLOSE, CLOSE).sum()) if same else 0


def _gives_all(
    case: Case, answers: Callable[[tuple[Any, ...]], Parts], S: Parts
) -> bool:
    """Return whether mistakes give all answers, those to the fresh questions too."""
    if not exactly(case.ask, answers(case.arguments), S):
        return False
    more = case.further
    return not more or exactly(case.ask, answers(more.arguments), more.S)


def _with(text: str) -> str:
    """Return how a slip reads, as one says it of a body."""
    left_out = text.removeprefix("without ")
    return f"with `{text}`" if left_out == text else f"without `{left_out}`"


def _rank(part: _Part) -> float:
    return rank(part.slip) if part.slip else NAMED


def _row(answer: Parts) -> Array:
    return np.concatenate([np.ravel(x) for x in answer]) if answer else np.empty(0)


def _tells(row: Array, its: Array) -> bool:
    """Return whether an answer is one, and another than the right one."""
    if row.shape != its.shape or not np.isfinite(row).all():
        return False
    return bool(np.abs(row - its).max(initial=0.0) > CLOSE)


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
