"""The matcher: which hypothesis explains all of a student's answers.

A hypothesis is screened at one call, then confirmed at all that are always asked and at
those that were drawn anew.
"""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from functools import cached_property, partial
from typing import Any

import numpy as np

from labkit.judge.answers import (
    InTurn,
    Parts,
    as_one,
    capitalised,
    own,
    parts,
    worst_part,
)
from labkit.judge.ask import Ask, Case, as_plain
from labkit.judge.effort import Effort
from labkit.judge.hypothesis import Difference
from labkit.judge.mutant import Body
from labkit.judge.results import numbers
from robo47.checks import Array
from robo47.errors import Robo47Error

Code = Callable[..., Any]  # of one question's arguments, or an InTurn
# Lines of a call that takes too long to screen all hypotheses there, and of one that
# returns so early that it may hide some.
COSTLY, BRIEF = 5000, 1000
FIRST = 3  # calls, which an author writes by hand, are short as a rule


@dataclass(frozen=True, eq=False)
class Calls:
    """Calls with a student's answers, the right ones, and those of a hypothesis."""

    ask: Ask
    arguments: tuple[Any, ...]  # stacked
    S: Parts
    T: Parts

    @cached_property
    def difference(self) -> Difference:
        """What a hypothesis has to explain."""
        return Difference(self.ask, self.S, self.T)

    def __len__(self) -> int:
        """Return how many there are."""
        return len(self.S[0])

    @cached_property
    def _columns(self) -> list[tuple[Any, ...]]:
        return [
            tuple(c[[i]] if isinstance(c, np.ndarray) else c for c in self.arguments)
            for i in range(len(self))
        ]

    @cached_property
    def each(self) -> list[tuple[Any, ...]]:
        """The arguments of each call, as a truth gets them."""
        return [
            tuple(
                as_plain(c[i]) if isinstance(c, np.ndarray) else c
                for c in self.arguments
            )
            for i in range(len(self))
        ]

    @cached_property
    def _sized(self) -> bool:
        """Whether the size of an answer follows the question."""
        return any(None in kind.shape for kind in self.ask.kinds)

    def answer(self, code: Code, i: int) -> Parts:
        """Return the answer to one call; () where there is none.

        Those of a named mistake, which several sources ask for, are kept.
        """
        if not isinstance(code, InTurn):
            return self._answer(code, i)
        key = id(code), i
        if key not in self._kept:  # an id stays that of what is kept
            self._kept[key] = code, self._answer(code, i)
        return self._kept[key][1]

    @cached_property
    def _kept(self) -> dict[tuple[int, int], tuple[Code, Parts]]:
        return {}

    def _answer(self, code: Code, i: int) -> Parts:
        try:
            if isinstance(code, InTurn):
                found = parts(code.each(self._columns[i])[0])
            else:
                value = code(*map(own, self.each[i]))
                found = parts(numbers(self.ask.kind, value))
        except Exception:  # it may stop in any way, as a student's function may
            return ()
        return self._filled(found)

    def answers(self, code: Code) -> Parts:
        """Return the answers to all calls; () where one of them has none."""
        some = [self.answer(code, i) for i in range(len(self))]
        if not all(some) or len({tuple(x.shape for x in one) for one in some}) > 1:
            return ()
        return tuple(np.array(part) for part in zip(*some, strict=True))

    def gives(self, code: Code, order: Iterable[int], digits: bool) -> bool:
        """Return whether a hypothesis explains every call, asked in an order."""
        fits = self.difference.fits
        return all(fits(i, self.answer(code, i), digits) for i in order)

    def _filled(self, answer: Parts) -> Parts:
        """Return an answer filled up with 0 to the size of the largest."""
        if not self._sized or len(answer) != len(self.T):
            return answer
        return tuple(
            part
            if part.shape == t.shape[1:] or part.ndim != t.ndim - 1
            else as_one([part, np.zeros(t.shape[1:])])[0]
            for part, t in zip(answer, self.T, strict=True)
        )


@dataclass(frozen=True, eq=False)
class Matcher:
    """A student's answers to the main calls and to fresh ones."""

    case: Case
    S: Parts  # the student's
    T: Parts  # the right ones
    known: dict[str, Any] = field(default_factory=dict)  # what a source has found
    effort: Effort = field(default_factory=Effort)  # that is left to make hypotheses

    @property
    def ask(self) -> Ask:
        """The function's row."""
        return self.case.ask

    @cached_property
    def whole(self) -> bool:
        """Whether equal answers prove little: counts, choices, truth values."""
        return any(kind.whole for kind in self.ask.kinds)

    @cached_property
    def main(self) -> Calls:
        """The calls that are always asked."""
        return Calls(self.ask, self.case.arguments, self.S, self.T)

    @cached_property
    def fresh(self) -> Calls | None:
        """Those that were drawn anew, and have an answer."""
        more = self.case.further
        return Calls(self.ask, more.arguments, more.S, more.T) if more else None

    @cached_property
    def right(self) -> Code | None:
        """A right function of one question that comes to an end; None without one.

        Other arguments may keep a loop busy for ever, so it is the lab's own, whose
        steps are limited, where that has loops. The library refuses some arguments
        which the lab takes, such as a point behind the camera of an inverted pose.
        """
        truth = self.ask.truth
        if not isinstance(truth, InTurn):
            return None
        body = next(iter(self.ask.bodies), None)
        if body is None:
            return truth.function
        if body.loops:
            return self.bodies[0].compiled()
        own = body.compiled()
        return own and partial(_unless_refused, truth.function, own)

    @cached_property
    def bodies(self) -> Sequence[Body]:
        """Right bodies whose mutants take no more than some times their steps.

        The lab's comes first, then the one whose mutants cost least, so that a slow one
        does not use up the search of all others.
        """
        for body in self.ask.bodies:
            body.calibrate(self.main.each[self.i])
        others = sorted(self.ask.bodies[1:], key=lambda body: body.steps.lines)
        return [*self.ask.bodies[:1], *others]

    @property
    def usual(self) -> int:
        """How many lines a call of the right function executes, or so."""
        return self.bodies[0].steps.lines if self.bodies else 0

    @property
    def lines(self) -> int:
        """How many lines the last call of the right function has executed, or so.

        Other arguments may take it as many steps as a mutant is allowed.
        """
        if not self.bodies:
            return 0
        body = self.bodies[0]
        return body.steps.taken if body.loops else body.steps.lines

    @cached_property
    def wrong(self) -> Any:
        """Which main calls have a wrong answer."""
        return np.flatnonzero(self.ask.gaps(self.S, self.T) > self.ask.near)

    @cached_property
    def i(self) -> int:
        """The call at which hypotheses are screened: drawn inputs hide less.

        Where that takes long, it is the shortest of these that is not brief.
        """
        if not len(self.wrong):
            return self.furthest
        drawn = len(self.main) - self.ask.drawn
        some = [i for i, n in self._lines.items() if n >= BRIEF and i >= drawn]
        return min(some, key=self._lines.__getitem__, default=int(self.wrong[-1]))

    @cached_property
    def shortest(self) -> int:
        """The call with a wrong answer that takes least, where the others take long."""
        return min(self._lines, key=self._lines.__getitem__, default=self.i)

    @property
    def costly(self) -> bool:
        """Whether a usual call takes long."""
        return bool(self._lines)

    @cached_property
    def _lines(self) -> dict[int, int]:
        """How many lines the first wrong calls and the drawn ones take, by call.

        It is empty where the last of them takes few.
        """
        wrong = self.wrong.tolist()
        if not wrong or self._lines_at(wrong[-1]) <= COSTLY:
            return {}
        drawn = len(self.main) - self.ask.drawn
        some = [i for i in wrong if i >= drawn]
        return {i: self._lines_at(i) for i in (wrong[-1], *some, *wrong[:FIRST])}

    def _lines_at(self, i: int) -> int:
        """Return how many lines the lab's function executes in a call, or so."""
        body = next(iter(self.ask.bodies), None)
        if body is None or not body.loops:
            return 0
        body.calibrate(self.main.each[i])
        return body.steps.lines

    @cached_property
    def furthest(self) -> int:
        """The call whose answer is furthest off."""
        return int(np.argmax(self.ask.gaps(self.S, self.T)))

    @cached_property
    def order(self) -> list[int]:
        """All main calls, those that tell most first, but before them a short one."""
        wrong = [self.shortest, self.i, self.furthest, *self.wrong[::-1].tolist()]
        return list(dict.fromkeys([*wrong, *range(len(self.main))]))

    def holds(self, code: Code, digits: bool = True) -> bool:
        """Return whether a hypothesis explains all answers, the fresh ones, too."""
        return self._in_all(code, digits) and self.main.difference.differs(
            self.main.answers(code)
        )

    def _in_all(self, code: Code, digits: bool) -> bool:
        if not self.main.gives(code, self.order, digits):
            return False
        fresh = self.fresh
        return fresh is None or fresh.gives(code, range(len(fresh)), digits)

    def exact(self, code: Code) -> bool:
        """Return whether a hypothesis gives all numbers, to what rounding leaves."""
        some = [self.main, self.fresh] if self.fresh else [self.main]
        return all(one.difference.equals(one.answers(code)) for one in some if one)

    def off(self) -> str:
        """Return how far the answers are off: "Largest error: 2 m."; "" of a NaN."""
        k = worst_part(self.ask.kinds, self.S, self.T, self.ask.near)
        if not np.isfinite(self.S[k]).all():
            return ""
        kind = self.ask.kinds[k]
        return kind.largest_error(self.S[k], self.T[k])

    def with_error(self, evidence: str) -> str:
        """Return how far the answers are off, and what explains them, as sentences."""
        return " ".join(filter(None, [self.off(), f"{capitalised(evidence)}."]))


def _unless_refused(function: Code, other: Code, *args: Any) -> Any:
    """Return a function's answer, or another's to arguments that the first refuses."""
    try:
        return function(*args)
    except (ValueError, Robo47Error):
        return other(*args)


def row(answer: Parts) -> Array:
    """Return an answer as one row of numbers."""
    return np.concatenate([np.ravel(x) for x in answer]) if answer else np.empty(0)
