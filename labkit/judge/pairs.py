"""Two mistakes at once: they are claimed where together they give all numbers."""

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from itertools import combinations
from typing import Any

import numpy as np

from labkit.judge import moves
from labkit.judge.answers import (
    MATCHES,
    InTurn,
    Parts,
    all_match,
    as_one,
    own,
    parts,
    rigid,
    worst_part,
)
from labkit.judge.ask import Ask, Case, as_plain
from labkit.judge.hypothesis import equals, evidence, explained, explains
from labkit.judge.mistake import Finding, Mistake

# What one mistake alone leaves right, two need not: "all is right except that ...".
_BUT = re.compile(
    r"^(?:[^;:]*?\b(?:is|are) right(?: except that|, but|;)"
    r"|right [^;,:]*[;,](?: but)?) "
)
MOST = 80  # mistakes of a function that are tried two at a time
QUICK = 2e-3  # seconds of a call that a row may say, for its arguments to be changed


def of_other_arguments(case: Case, S: Parts, T: Parts) -> Finding | None:
    """Return that the answers are the right ones to other arguments, or None.

    Such as two exchanged, or one of the other sign: a slip that needs no name.
    """
    ask = case.ask
    truth = ask.truth
    whole = any(kind.whole for kind in ask.kinds)
    if whole or ask.seconds > QUICK or not isinstance(truth, InTurn):
        return None
    i = tried(ask, S, T)[0]
    for move in _moves(case, i):
        asked = ask.in_turn(partial(_after, truth.function, move.change))
        answer = answer_to(asked, case.arguments, i, T)
        if not explained(ask, nth(S, i), nth(T, i), answer).all():
            continue
        again = answers_to(asked, case.arguments)
        if explains(ask, S, T, again):
            k = worst_part(ask.kinds, S, T, ask.near)
            off = f"Off by up to {ask.kinds[k].apart(S[k], T[k])}"
            says = f"It is the right answer to other arguments: with {move.says}."
            how = f"({off}; that {evidence(equals(ask.kinds, S, again))}.)"
            return Finding(f"argument-{move.slug}", f"{says} {how}")
    return None


def tried(ask: Ask, S: Parts, T: Parts) -> list[int]:
    """Return the calls that pairs are tried at.

    Drawn inputs come last, and hide less; what is furthest off is tried besides.
    """
    gap = ask.gaps(S, T)
    furthest = int(np.argmax(gap))
    wrong = np.flatnonzero(gap > ask.near)
    return list(dict.fromkeys([int(wrong[-1]) if len(wrong) else furthest, furthest]))


def _moves(case: Case, i: int) -> Iterator[moves.Move]:
    """Yield what may be done to the arguments, as those of the i-th call are."""
    columns = case.arguments
    call = [as_plain(c[i]) if isinstance(c, np.ndarray) else c for c in columns]
    names = case.names
    if len(names) != len(call):
        names = [f"argument {k + 1}" for k in range(len(call))]
    yield from moves.of_arguments(tuple(map(own, call)), names)


def two_at_once(case: Case, S: Parts, T: Parts) -> Finding | None:
    """Return two named mistakes that together give the student's answers, or None.

    Two terms that are wrong add up: what both make is the one answer and the other's
    difference from the right one. A mistake made with an argument comes before another,
    and one made with the finished answer after it.
    """
    ask = case.ask
    if any(kind.whole for kind in ask.kinds):
        return None
    found = (_two_of(case, S, T, i) for i in tried(ask, S, T))
    return next((_both_told(ask, pair, S, T) for pair in found if pair), None)


def _two_of(case: Case, S: Parts, T: Parts, i: int) -> Sequence[Mistake] | None:
    """Return two mistakes that together give all answers, found at the i-th call."""
    ask = case.ask
    mistakes = of_its_own_first(ask)
    answers = {}
    for k, one in enumerate(mistakes):
        answer = answer_to(one.redo, case.arguments, i, T)
        wrong = alike(ask, answer, nth(T, i)) is False
        if wrong and not _handed_back(answer, case.arguments, i):
            answers[k] = answer
    pairs = _Pairs(case, S, T, i, mistakes, answers)
    found = pairs.of_its_kind() or pairs.added() or pairs.finished()
    return found or pairs.in_turn()


def of_its_own_first(ask: Ask) -> list[Mistake]:
    """Return the mistakes that are tried two at a time, a function's own first."""
    mistakes = [one for one in ask.named if isinstance(one.redo, InTurn)]
    return sorted(mistakes, key=lambda one: one.reached)[:MOST]


@dataclass(frozen=True)
class Pair:
    """Two mistakes, and the answers that both make together."""

    first: Mistake
    second: Mistake
    redo: InTurn


@dataclass(frozen=True)
class _Pairs:
    """Pairs of mistakes beside a student's answers: one call's first, then all."""

    case: Case
    S: Parts  # the student's
    T: Parts  # the right ones
    i: int  # the call that is furthest off
    mistakes: Sequence[Mistake]
    answers: Mapping[int, Parts]  # to that call, of those that are wrong there

    def added(self) -> Sequence[Mistake] | None:
        """Return two mistakes whose differences, or factors, come together."""
        its = nth(self.T, self.i)
        for a, b in combinations(self.answers, 2):
            first = self.mistakes[a]
            second = self.mistakes[b]
            if first.slug == second.slug:
                continue
            pair = self.answers[a], self.answers[b]
            if any(map(self._is_another_pose, pair)):
                continue
            for combined in (_sum, _product):
                if not self._is_this_one(combined(*pair, its)):
                    continue
                one = self._every(first.redo)
                other = self._every(second.redo)
                if combined is _product and _one_factor(one, other, self.T):
                    continue
                if exactly(self.case.ask, combined(one, other, self.T), self.S):
                    return first, second
        return None

    def _is_another_pose(self, answer: Parts) -> bool:
        """Return whether both R and t are wrong: that is no term of a sum."""
        its = self.T[0][self.i]
        if len(answer) != 1 or answer[0].shape[1:] != (4, 4) or not rigid(its[None]):
            return False
        off = np.abs(answer[0][0] - its)
        return bool(off[:3, :3].max() > MATCHES and off[:3, 3].max() > MATCHES)

    def of_its_kind(self) -> Sequence[Mistake] | None:
        """Return two mistakes that any function of this kind can have."""
        if len(self.case.ask.kinds) != 1:
            return None
        general = list(self.case.ask.kinds[0].general())
        its = nth(self.T, self.i)
        for first, change in combinations(general, 2):
            if self._is_this_one(_changed(change, _changed(first, its))):
                every = _changed(change, _changed(first, self.T))
                if exactly(self.case.ask, every, self.S):
                    return first, change
        return None

    def finished(self) -> Sequence[Mistake] | None:
        """Return a mistake and another that is made with its finished answer."""
        if len(self.case.ask.kinds) != 1:
            return None
        general = self.case.ask.kinds[0].general()
        for change in [*general, *self._of_the_answer]:
            for k, answer in self.answers.items():
                if self._is_this_one(_changed(change, answer)):
                    every = self._every(self.mistakes[k].redo)
                    if exactly(self.case.ask, _changed(change, every), self.S):
                        return self.mistakes[k], change
        return None

    def in_turn(self) -> Sequence[Mistake] | None:
        """Return a mistake made with arguments and one after it, or two options."""
        for pair in self._that_combine():
            if self._is_this_one(self._answer(pair.redo)):
                every = self._every(pair.redo)
                if exactly(self.case.ask, every, self.S):
                    return pair.first, pair.second
        return None

    def _that_combine(self) -> Iterator[Pair]:
        """Yield pairs that can be made together.

        The first is made with arguments, or both are one function's with other options,
        as `partial` gives them.
        """
        for i, first in enumerate(self.mistakes):
            one: Any = first.redo
            given = getattr(one.function, "given", None) or self._of_arguments.get(i)
            for k, second in enumerate(self.mistakes):
                other: Any = second.redo
                if first.slug == second.slug:
                    continue
                both: Callable[..., Any] | None = None
                if given:
                    both = partial(_after, other.function, given)
                elif i < k and _options(one.function, other.function):
                    both = partial(one.function, **other.function.keywords)
                if both:
                    yield Pair(first, second, self.case.ask.in_turn(both))

    @cached_property
    def _of_arguments(self) -> dict[int, Callable[..., Any]]:
        """Which mistakes are the right answer to other arguments."""
        found: dict[int, Callable[..., Any]] = {}
        truth = self.case.ask.truth
        if self.case.ask.seconds > QUICK or not isinstance(truth, InTurn):
            return found
        for _, _, change in _moves(self.case, self.i):
            asked = self.case.ask.in_turn(partial(_after, truth.function, change))
            answer = self._answer(asked)
            for k in self._that_give(answer, partial(self._every, asked)):
                found.setdefault(k, change)
        return found

    def _answer(self, redo: Callable[..., Any]) -> Parts:
        return answer_to(redo, self.case.arguments, self.i, self.T)

    def _every(self, redo: Callable[..., Any]) -> Parts:
        return answers_to(redo, self.case.arguments)

    def _that_give(self, answer: Parts, every: Callable[[], Parts]) -> Iterator[int]:
        """Yield the first mistake that gives an answer at one call, and at all."""
        for k, its in self.answers.items():
            if answer and alike(self.case.ask, answer, its):
                if alike(self.case.ask, every(), self._every(self.mistakes[k].redo)):
                    yield k
                return

    @cached_property
    def _of_the_answer(self) -> list[Mistake]:
        """Mistakes that are a change of the right answer, as such changes."""
        its = nth(self.T, self.i)[0]
        found = []
        for change in moves.of_answer(its[0]):
            answer = (np.asarray(change(its)),)
            for k in self._that_give(answer, partial(_as_answer, change, self.T[0])):
                found.append(replace(self.mistakes[k], redo=change))
        return found

    def _is_this_one(self, answer: Parts) -> bool:
        return exactly(self.case.ask, answer, nth(self.S, self.i))


def _handed_back(answer: Parts, arguments: tuple[Any, ...], i: int) -> bool:
    """Return whether an answer is an argument as it came: nothing was made of it."""
    columns = [c for c in arguments if isinstance(c, np.ndarray)]
    return any(
        np.shape(c[i]) == part.shape[1:] and np.allclose(part[0], c[i])
        for part in answer
        for c in columns
        if np.size(c[i]) > 1
    )


def _after(
    function: Callable[..., Any], change: Callable[..., tuple[Any, ...]], *args: Any
) -> Any:
    """Return the answer to changed arguments."""
    return function(*change(*args))


def _as_answer(change: Callable[[Any], Any], T: Any) -> Parts:
    return (np.asarray(change(T)),)


def _options(one: Any, other: Any) -> bool:
    """Return whether two are the same function with different options."""
    if not (isinstance(one, partial) and isinstance(other, partial)):
        return False
    return one.func is other.func and not one.keywords.keys() & other.keywords.keys()


def answer_to(
    redo: Callable[..., Any], arguments: tuple[Any, ...], i: int, like: Parts
) -> Parts:
    """Return the answer to one question with a mistake, or with two; () for none.

    It is filled up with 0 to the size of `like`, as answers of several sizes are.
    """
    column = [c[[i]] if isinstance(c, np.ndarray) else c for c in arguments]
    answer = nth(answers_to(redo, tuple(column)), 0)
    pairs = list(zip(answer, like, strict=False))
    if any(x.ndim != its.ndim for x, its in pairs):
        return answer
    return tuple(as_one([x[0], np.zeros(its.shape[1:])])[:1] for x, its in pairs)


def answers_to(redo: Callable[..., Any], arguments: tuple[Any, ...]) -> Parts:
    """Return the answers to all questions with a mistake; () where it has none."""
    try:
        with np.errstate(all="ignore"):
            return parts(redo(*arguments))
    except (ValueError, np.linalg.LinAlgError):
        return ()


def _changed(change: Mistake, answer: Parts) -> Parts:
    """Return an answer with a mistake that is made when it is finished."""
    try:
        return parts(change.redo(answer[0])) if answer else ()
    except (ValueError, np.linalg.LinAlgError):
        return ()


def nth(some: Parts, i: int) -> Parts:
    """Return the answer to one question, as a set of one."""
    return tuple(part[i : i + 1] for part in some)


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
    one, other, its = (np.concatenate([np.ravel(x) for x in p]) for p in (a, b, right))
    if not one.shape == other.shape == its.shape:
        return False
    told = (one * its > 0) & (other * its > 0)
    x, y = (np.log(some[told] / its[told]) for some in (one, other))
    if not len(x) or min(np.ptp(x), np.ptp(y)) < MATCHES:
        return False  # a number that is the same everywhere is no power of a term
    power = (x @ y) / (x @ x)
    return bool(np.abs(y - power * x).max() <= MATCHES * np.abs(y).max())


def alike(ask: Ask, a: Parts, b: Parts) -> bool | None:
    """Return whether two answers match; None where there is none."""
    if len(a) != len(b):
        return None
    return all_match(ask.kinds, a, b)


def exactly(ask: Ask, a: Parts, b: Parts) -> bool:
    """Return whether two answers match in all the digits that rounding leaves."""
    return equals(ask.kinds, b, a)


def _both_told(ask: Ask, pair: Sequence[Mistake], S: Parts, T: Parts) -> Finding:
    i = worst_part(ask.kinds, S, T, ask.near)
    says = "; ".join(_BUT.sub("", one.says.rstrip("?")) for one in pair)
    off = f"Off by up to {ask.kinds[i].apart(S[i], T[i])}"
    how = f"{off}; both together give your numbers exactly"
    slug = "+".join(one.slug for one in pair)
    return Finding(slug, f"Two things at once: {says}. ({how}.)")
