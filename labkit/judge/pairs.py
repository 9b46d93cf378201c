"""Pairs of hypotheses: two that together give all of a student's answers.

Each half has a sentence that stands alone, or the pair is not told.
"""

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from itertools import combinations, islice
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from labkit.judge import changes
from labkit.judge.answers import (
    MATCHES,
    InTurn,
    Parts,
    all_match,
    parts,
    rigid,
)
from labkit.judge.effort import LINES, Effort
from labkit.judge.hypothesis import EXACT, evidence
from labkit.judge.matcher import Code, Matcher, row
from labkit.judge.mistake import ADD_UP, BOTH, Finding, Mistake, both_told
from labkit.judge.mutant import Mutant
from labkit.judge.sentence import half
from labkit.judge.sources import SCREEN, after, answered_near
from robo47.checks import Array

# What one mistake alone leaves right, two need not: "all is right except that ...".
_BUT = re.compile(
    r"^(?:[^;:]*?\b(?:is|are) (?:right|correct)(?: except that|, but|;)"
    r"|right [^;,:]*[;,](?: but)?) "
)
# Between what a function does and the rule; "x . H x" is no end of a sentence.
_RULE = re.compile(r"(?<=\S)\. (?=[A-Z])")
MOST = 80  # mistakes of a function that are tried two at a time
SUMS = 400  # pairs that add up at one call, of which some do at all
LIKELY = 3  # first mutants beside which all others are tried
KEEP = 0.2  # share of a search's effort that is left for mutants beside others
IN_TURN, BESIDE = 0.3, 0.1  # shares of one for pairs made in turn, or that add up
NAMED = 1.5  # a named mistake comes after two signs, and before the other mutants
# Mutants that may be one of two: by factors and numbers a sum is made in many ways.
ALONG = {"sign", "negated", "left-out", "name", "order", "transpose", "index", "line"}
MADE = f"{BOTH} {evidence(True)}"
MULTIPLY = "The factors of both mistakes together give the output of your code"
Together = Any  # from the answers of two hypotheses and the right ones to both at once


class _Two(NamedTuple):
    """Two mistakes that together give all answers, and how they do."""

    first: Mistake
    second: Mistake
    how: str = MADE
    in_turn: bool = False  # whether the second is a change of what the first gives


def of_its_own_first(m: Matcher) -> list[Mistake]:
    """Return the mistakes that are tried two at a time, a function's own first."""
    mistakes = [one for one in m.ask.named if isinstance(one.redo, InTurn)]
    return sorted(mistakes, key=lambda one: one.reached)[:MOST]


def two_at_once(m: Matcher) -> Finding | None:
    """Return two named mistakes that together give the student's answers, or None."""
    if m.whole:
        return None
    effort = Effort(int(IN_TURN * LINES))
    for i in dict.fromkeys([m.i] if m.costly else [m.i, m.furthest]):
        pairs = _Pairs(m, i, effort)
        some = (pairs.of_its_kind, pairs.added, pairs.finished, pairs.in_turn)
        tried = filter(None, (one() for one in some))
        if found := next((two for two in tried if not _cancel(m, two)), None):
            two = (found.first, found.second)
            says = [_BUT.sub("", one.says) for one in two]
            slugs = [one.slug for one in two]
            return _told(m, slugs, says, found.how, found.in_turn)
    return None


def _cancel(m: Matcher, two: "_Two") -> bool:
    """Return whether an entry is right in all answers that each half makes wrong.

    A transposed inverse has the right rotation; neither half is seen in it.
    """
    halves = [_alone(m, one) for one in (two.first, two.second)]
    return any(
        bool((~_off(s, t) & _off(a, t) & _off(b, t)).any())
        for s, t, a, b in zip(m.S, m.T, *halves, strict=False)
        if s.shape == t.shape == a.shape == b.shape
    )


def _alone(m: Matcher, one: Mistake) -> Parts:
    """Return the answers to the main questions of one mistake alone."""
    if isinstance(one.redo, InTurn):
        return m.main.answers(one.redo)
    return _changed(one, m.main.T)


def _off(some: Array, right: Array) -> NDArray[np.bool_]:
    """Return which entries of answers, (n, ...), are off in some call, (...)."""
    far = np.abs(some - right) > MATCHES * (1.0 + np.abs(right))
    return np.asarray(far.any(axis=0))


def _told(
    m: Matcher,
    slugs: Sequence[str],
    says: Sequence[str],
    how: str,
    in_turn: bool = False,
) -> Finding | None:
    """Return what is said of a pair; None where both halves say the same."""
    says = [_RULE.split(one)[0] for one in says]  # a rule would break the list
    if len(set(says)) < len(says):
        return None
    first, second = says
    told = both_told(first, second, in_turn)
    return Finding("+".join(slugs), f"{told} {m.with_error(how)}")


@dataclass(frozen=True)
class _Pairs:
    """Pairs of an author's mistakes: one call's answers first, then all."""

    m: Matcher
    i: int  # the call at which they are screened
    effort: Effort = field(default_factory=Effort)  # for those that are made in turn

    @cached_property
    def mistakes(self) -> list[Mistake]:
        return of_its_own_first(self.m)

    @cached_property
    def answers(self) -> Mapping[int, Parts]:
        """The answers of those that are wrong there."""
        found = {}
        for k, one in enumerate(self.mistakes):
            answer = self.m.main.answer(one.redo, self.i)
            wrong = answer and not _alike(self.m, answer, self._right)
            if wrong and not _handed_back(answer, self.m.main.each[self.i]):
                found[k] = answer
        return found

    @cached_property
    def _right(self) -> Parts:
        return tuple(t[self.i] for t in self.m.T)

    def added(self) -> _Two | None:
        """Return two mistakes whose differences, or factors, come together."""
        for a, b, both in self._near_together():
            pair = self.mistakes[a], self.mistakes[b]
            some = self.answers[a], self.answers[b]
            if pair[0].slug == pair[1].slug or any(map(self._is_another_pose, some)):
                continue
            if not self._fits(both(*some, self._right)):
                continue
            one, other = (self.m.main.answers(x.redo) for x in pair)
            factor = both is _product and _one_factor(one, other, self.m.T)
            if not factor and _add_up(self.m, pair[0].redo, pair[1].redo, both):
                return _Two(*pair, MULTIPLY if both is _product else ADD_UP)
        return None

    def _near_together(self) -> Iterator[tuple[int, int, Together]]:
        """Yield the pairs whose sum, or product, may be the student's answer.

        All sums with one mistake are compared at once; a number that is none passes.
        """
        its, mine = row(self._right), row(tuple(s[self.i] for s in self.m.S))
        free = self.m.main.difference.free(self.i)
        alike, rows = self._rows
        for n, a in enumerate(alike):
            sums = rows[n] + rows[n + 1 :] - its
            products = np.where(its, rows[n] * rows[n + 1 :] / np.where(its, its, 1), 0)
            far = [np.abs(x - mine) > free for x in (sums, products)]
            adds, multiplies = (np.all(~one, axis=1).tolist() for one in far)
            for j, b in enumerate(alike[n + 1 :]):
                yield from [(a, b, _sum)] * adds[j]
                yield from [(a, b, _product)] * multiplies[j]

    def _is_another_pose(self, answer: Parts) -> bool:
        """Return whether both R and t are wrong: that is no term of a sum."""
        (its, *_) = self._right
        if len(answer) != 1 or answer[0].shape != (4, 4) or not rigid(its[None]):
            return False
        off = np.abs(answer[0] - its)
        return bool(off[:3, :3].max() > MATCHES and off[:3, 3].max() > MATCHES)

    def of_its_kind(self) -> _Two | None:
        """Return two mistakes that any function of this kind can have."""
        if len(self.m.T) != 1:
            return None
        for first, change in combinations(self.m.ask.kinds[0].general(), 2):
            made = [
                _changed(change, _changed(first, calls.T))
                for calls in filter(None, (self.m.main, self.m.fresh))
            ]
            if self._all_fit(made):
                return _Two(first, change, in_turn=True)
        return None

    def _all_fit(self, made: Sequence[Parts]) -> bool:
        calls = filter(None, (self.m.main, self.m.fresh))
        return all(
            len(some) == 1
            and len(some[0]) == len(one)
            and all(
                one.difference.fits(i, (some[0][i],), digits=True)
                for i in range(len(one))
            )
            for some, one in zip(made, calls, strict=True)
        )

    def finished(self) -> _Two | None:
        """Return a mistake and another that is made with its finished answer."""
        if len(self.m.T) != 1:
            return None
        general = self.m.ask.kinds[0].general()
        for change in [*general, *self._of_the_answer]:
            for k, answer in self.answers.items():
                one = tuple(x[None] for x in answer)
                if not self._fits(tuple(x[0] for x in _changed(change, one))):
                    continue
                redo = partial(_finished, change, self.mistakes[k].redo)
                if self.m.holds(redo):
                    return _Two(self.mistakes[k], change, in_turn=True)
        return None

    def in_turn(self) -> _Two | None:
        """Return a mistake made with arguments and one after it, or two options."""
        for first, second, code in self._that_combine():
            if self.effort.spent():
                break
            self.effort.spend(self.m.usual)
            if self.m.holds(code):
                return self._of_these_arguments(first) or _Two(first, second)
        return None

    def _that_combine(self) -> Iterator[tuple[Mistake, Mistake, Code]]:
        """Yield pairs that can be made together.

        The first is made with arguments, or both are one function's with other options,
        as `partial` gives them. Such options show at any call with a wrong answer, so
        they are tried at one.
        """
        first_look = self.i == self.m.i
        asked = self.m.known.setdefault("in turn", set())
        for i, first in enumerate(self.mistakes):
            one: Any = first.redo
            given = _given(first) or self._of_arguments.get(i)
            for k, second in enumerate(self.mistakes):
                other: Any = second.redo
                if first.slug == second.slug or (i, k) in asked:
                    continue
                if given:
                    asked.add((i, k))
                    yield first, second, partial(after, other.function, given)
                elif i < k and first_look and _options(one.function, other.function):
                    both = partial(one.function, **other.function.keywords)
                    yield first, second, both

    def _of_these_arguments(self, first: Mistake) -> _Two | None:
        """Return a mistake, and another change of the arguments as they were given.

        The second of a pair may be about arguments that the first has changed: the last
        joint of a reversed chain is the first one.
        """
        again: Any = first.redo
        for one in self.mistakes if not _given(first) else ():
            if one.slug != first.slug and (given := _given(one)):
                self.effort.spend(self.m.usual)
                if self.m.holds(partial(after, again.function, given)):
                    return _Two(one, first)
        return None

    @cached_property
    def _of_arguments(self) -> dict[int, Code]:
        """Which mistakes are the right answer to other arguments."""
        found: dict[int, Code] = {}
        if self.m.right is None:
            return found
        call, names = self.m.main.each[self.i], self.m.case.names
        tried = self.m.known.get("arguments", ()) if self.i == self.m.i else ()
        known = {one.says: answer for one, _, answer in tried}
        for one in changes.likely(call, names):
            if self.m.effort.spent(KEEP):
                break
            code = partial(after, self.m.right, one.change)
            if (answer := known.get(one.says)) is None:
                answer = self._charged(code, self.i)
            if answer:
                for k in self._that_give(answer, partial(self._charged, code)):
                    found.setdefault(k, one.change)
        return found

    def _charged(self, code: Code, i: int) -> Parts:
        """Return the right function's answer to other arguments, which costs effort."""
        answer = self.m.main.answer(code, i)
        self.m.effort.spend(self.m.lines)
        return answer

    def _that_give(self, answer: Parts, other: Callable[[int], Parts]) -> Iterator[int]:
        """Yield the first mistake that gives an answer at one call, and at all.

        Args:
            answer: to the call at which it is screened.
            other: the answer to any call.
        """
        for k in self._near(answer):
            if _alike(self.m, answer, self.answers[k]):
                redo = self.mistakes[k].redo
                if self._give_all(other, partial(self.m.main.answer, redo)):
                    yield k
                return

    def _near(self, answer: Parts) -> Iterator[int]:
        """Yield the mistakes whose answers may be alike, compared all at once."""
        alike, rows = self._rows
        wanted = row(answer)
        if len(wanted) != rows.shape[1]:
            yield from (k for k in self.answers if k not in alike)
            return
        apart = np.abs(rows - wanted) / self._scales
        size = np.nanmax(np.abs(wanted) / self._scales, initial=1.0)
        far = np.any(apart > 2 * MATCHES * size, axis=1)
        yield from (alike[j] for j in np.flatnonzero(~far))

    @cached_property
    def _rows(self) -> tuple[list[int], Array]:
        """The mistakes whose answers have the shapes of the right one, and these."""
        shapes = [x.shape for x in self._right]
        some = self.answers.items()
        alike = [k for k, one in some if [x.shape for x in one] == shapes]
        size = sum(x.size for x in self._right)
        rows = [row(self.answers[k]) for k in alike]
        return alike, np.array(rows).reshape(len(alike), size)

    @cached_property
    def _scales(self) -> Array:
        pairs = zip(self._right, self.m.ask.kinds, strict=True)
        some = [np.broadcast_to(kind.scale, x.shape) for x, kind in pairs]
        return row(tuple(some))

    def _give_all(
        self, one: Callable[[int], Parts], other: Callable[[int], Parts]
    ) -> bool:
        """Return whether two answer all calls alike; the first that differs ends it."""
        pairs = []
        for i in self.m.order:
            a, b = (tuple(x[None] for x in some(i)) for some in (one, other))
            if not (a and b and all_match(self.m.ask.kinds, a, b, SCREEN)):
                return False
            pairs.append((a, b))
        if len({tuple(x.shape for x in mine) for mine, _ in pairs}) > 1:
            return False
        mine, its = (
            tuple(map(np.concatenate, zip(*some, strict=True)))
            for some in zip(*pairs, strict=True)
        )
        return _all_alike(self.m, mine, its)

    @cached_property
    def _of_the_answer(self) -> list[Mistake]:
        """Mistakes that are a change of the right answer, as such changes."""
        (T,) = self.m.T
        found = []
        for change in changes.simple(T[0]):

            def at(i: int, change: Code = change) -> Parts:
                return (np.asarray(change(T[i : i + 1]))[0],)

            for k in self._that_give(at(self.i), at):
                found.append(replace(self.mistakes[k], redo=change))
        return found

    def _fits(self, answer: Parts) -> bool:
        return self.m.main.difference.fits(self.i, answer, digits=True)


def _given(one: Mistake) -> Code | None:
    """Return the change of the arguments that a mistake is, if it says so."""
    redo: Any = one.redo
    return getattr(redo.function, "given", None)


def _finished(change: Mistake, redo: Any, *args: Any) -> Any:
    """Return the answer of a mistake with another one made when it is finished."""
    (answer,) = parts(redo.numbers(redo.function(*args)))
    return np.asarray(change.redo(answer[None]))[0]


def _handed_back(answer: Parts, call: Sequence[Any]) -> bool:
    """Return whether an answer is an argument as it came: nothing was made of it."""
    return any(
        isinstance(x, np.ndarray)
        and x.size > 1
        and x.dtype.kind == "f"
        and x.shape == part.shape
        and np.allclose(part, x)
        for part in answer
        for x in call
    )


def _options(one: Any, other: Any) -> bool:
    """Return whether two are the same function with different options."""
    if not (isinstance(one, partial) and isinstance(other, partial)):
        return False
    return one.func is other.func and not one.keywords.keys() & other.keywords.keys()


def _changed(change: Mistake, answer: Parts) -> Parts:
    """Return an answer with a mistake that is made when it is finished."""
    try:
        return parts(change.redo(answer[0])) if answer else ()
    except (ValueError, np.linalg.LinAlgError):
        return ()


def _sum(a: Parts, b: Parts, right: Parts) -> Parts:
    """Return what two wrong terms make together."""
    trios = list(zip(a, b, right, strict=False))
    if any(len({x.shape for x in trio}) > 1 for trio in trios):
        return ()
    return tuple(x + y - z for x, y, z in trios)


def _product(a: Parts, b: Parts, right: Parts) -> Parts:
    """Return what two wrong factors make together; () where 0 would hide one."""
    trios = list(zip(a, b, right, strict=False))
    if any(len({x.shape for x in trio}) > 1 for trio in trios):
        return ()
    if any(((z == 0) & ((x != 0) | (y != 0))).any() for x, y, z in trios):
        return ()
    return tuple(np.where(z == 0, 0.0, x * y / np.where(z, z, 1)) for x, y, z in trios)


def _one_factor(a: Parts, b: Parts, right: Parts) -> bool:
    """Return whether two wrong factors are powers of one, "squared" and "not cubed".

    They are two ways in which one term is wrong, and it cannot be wrong in both.
    """
    one, other, its = map(row, (a, b, right))
    if not one.shape == other.shape == its.shape:
        return False
    told = (one * its > 0) & (other * its > 0)
    x, y = (np.log(some[told] / its[told]) for some in (one, other))
    if not len(x) or min(np.ptp(x), np.ptp(y)) < MATCHES:
        return False  # a number that is the same everywhere is no power of a term
    power = (x @ y) / (x @ x)
    return bool(np.abs(y - power * x).max() <= MATCHES * np.abs(y).max())


def _add_up(m: Matcher, one: Code, other: Code, both: Together = _sum) -> bool:
    """Return whether the differences of two hypotheses give all answers together.

    The call at which they were found comes last: it refutes none.
    """
    order = sorted(m.order, key=lambda i: i == m.i)
    for calls in filter(None, (m.main, m.fresh)):
        for i in order if calls is m.main else range(len(calls)):
            its = tuple(t[i] for t in calls.T)
            pair = calls.answer(one, i), calls.answer(other, i)
            if not all(pair) or not calls.difference.fits(i, both(*pair, its), True):
                return False
    return True


def _alike(m: Matcher, a: Parts, b: Parts) -> bool:
    return _all_alike(m, tuple(x[None] for x in a), tuple(x[None] for x in b))


def _all_alike(m: Matcher, a: Parts, b: Parts) -> bool:
    """Return whether two sets of answers match."""
    return bool(a) and all_match(m.ask.kinds, a, b)


@dataclass(frozen=True)
class _Half:
    """A mutant or a named mistake, as one of two."""

    m: Matcher
    answer: Parts  # to one call
    one: Mistake | Mutant

    @property
    def rank(self) -> float:
        return self.one.rank if isinstance(self.one, Mutant) else NAMED

    @cached_property
    def code(self) -> Code | None:
        return self.one.code if isinstance(self.one, Mutant) else self.one.redo

    @property
    def slug(self) -> str:
        one = self.one
        return f"slip-{one.kind}" if isinstance(one, Mutant) else one.slug

    @cached_property
    def says(self) -> str:
        """The sentence that stands alone; "" without one."""
        one = self.one
        return half(self.m, one) if isinstance(one, Mutant) else one.says

    def apart(self, other: "_Half") -> bool:
        """Return whether two are of two places, and not both named: that is tried."""
        pair = self.one, other.one
        if isinstance(pair[0], Mutant) and isinstance(pair[1], Mutant):
            return not pair[0].overlaps(pair[1])
        return any(isinstance(one, Mutant) for one in pair)


def beside(m: Matcher) -> Finding | None:
    """Return two mutants, or one and a named mistake, that add up to the answers."""
    its = row(tuple(t[m.i] for t in m.T))
    known = [one for one in _halves(m) if _tells(row(one.answer), its)]
    if not known:
        return None
    off = np.array([row(one.answer) for one in known]) - its
    mine = row(tuple(s[m.i] for s in m.S))
    sums = islice(_sums(off, mine - its), SUMS)
    pairs = [(known[a], known[b]) for a, b in sums]
    effort = Effort(int(BESIDE * LINES))
    for one, other in sorted(pairs, key=lambda pair: pair[0].rank + pair[1].rank):
        tells = one.apart(other) and one.says and other.says
        if not tells or one.says == other.says:
            continue
        if effort.spent():
            break
        effort.spend(2 * m.usual)
        if one.code and other.code and _add_up(m, one.code, other.code):
            return _told(m, [one.slug, other.slug], [one.says, other.says], ADD_UP)
    return None


def _halves(m: Matcher) -> Iterator[_Half]:
    """Yield what may be one of two: named mistakes, and mutants."""
    near = [] if m.whole else answered_near(m)
    for one in of_its_own_first(m) if near else []:
        yield _Half(m, m.main.answer(one.redo, m.i), one)
    for mutant, answer in near:
        if mutant.kind in ALONG:
            yield _Half(m, answer, mutant)


def second(m: Matcher) -> Finding | None:
    """Return two mutants of which the second works on what the first made, or None.

    The first is one that gives more of the student's numbers than the right answers do.
    Of a slow function they are not looked for.
    """
    for first in [] if m.whole else _likely(m):
        for other, code in m.bodies[0].besides(first):
            if m.effort.spent():
                return None
            answer = m.main.answer(code, m.i)
            m.effort.spend(m.bodies[0].steps.taken)
            if m.main.difference.fits(m.i, answer, digits=True) and m.holds(code):
                says = [half(m, first), half(m, other)]
                slugs = [f"slip-{one.kind}" for one in (first, other)]
                if all(says) and (found := _told(m, slugs, says, MADE)):
                    return found
    return None


def _likely(m: Matcher) -> list[Mutant]:
    """Return the mutants that give most numbers of a wrong answer."""
    mine, its = (row(tuple(x[m.i] for x in some)) for some in (m.S, m.T))
    scores = [(_common(row(answer), mine), one) for one, answer in answered_near(m)]
    best = sorted(scores, key=lambda pair: -pair[0])[:LIKELY]
    return [one for score, one in best if score > _common(its, mine)]


def _common(one: Array, other: Array) -> int:
    """Return how many numbers of two answers are the same."""
    same = one.shape == other.shape
    return int(np.isclose(one, other, EXACT, EXACT).sum()) if same else 0


def _tells(answer: Array, its: Array) -> bool:
    """Return whether an answer is one, and another than the right one."""
    if answer.shape != its.shape or not np.isfinite(answer).all():
        return False
    return bool(np.abs(answer - its).max(initial=0.0) > EXACT)


def _sums(off: Array, wanted: Array) -> Iterator[tuple[int, int]]:
    """Yield pairs of rows of off, (n, m), whose sum is the wanted row."""
    if not np.isfinite(wanted).all():
        return
    onto = np.random.default_rng(len(wanted)).uniform(0.5, 1.5, len(wanted))
    shadow = off @ onto
    order = np.argsort(shadow)
    near = EXACT * max(1.0, float(np.abs(off).max()))
    low = np.searchsorted(shadow[order], wanted @ onto - shadow - near)
    high = np.searchsorted(shadow[order], wanted @ onto - shadow + near)
    for a in range(len(off)):
        for b in sorted(order[low[a] : high[a]]):
            if b > a and np.abs(off[a] + off[b] - wanted).max() <= near:
                yield a, int(b)
