"""A named mistake made again: it is claimed where that gives the student's numbers."""

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import combinations, permutations
from typing import Any

import numpy as np

from labkit.judge.answers import (
    MATCHES,
    InTurn,
    Parts,
    all_match,
    as_one,
    capitalised,
    gaps,
    largest,
    matches,
    parts,
    worst_part,
)
from labkit.judge.ask import Ask, Case, Further
from labkit.judge.mistake import Finding, Mistake

# What one mistake alone leaves right, two need not: "all is right except that ...".
_BUT = re.compile(
    r"^(?:[^;:]*?\b(?:is|are) right(?: except that|, but|;)"
    r"|right [^;,:]*[;,](?: but)?) "
)
EXACT = 1e-8  # of many pairs one comes near by chance, so two must give more digits
MOST = 80  # mistakes of a function that are tried two at a time


def _named(
    mistakes: Sequence[Mistake],
    arguments: tuple[Any, ...],
    kinds: Sequence[Any],
    S: Parts,
    T: Parts | None,
    near: float,
) -> Finding | None:
    """Return the first mistake that, made on purpose, gives the student's answers."""
    first = -1 if T is None else int(np.argmax(gaps(kinds, S, T)))
    for mistake in mistakes:
        try:
            again = _made_again(mistake.redo, arguments, kinds, S, first)
        except (ValueError, np.linalg.LinAlgError):  # it has no answer of its own here
            continue
        if all_match(kinds, S, again):
            says = capitalised(mistake.says)
            says += "" if says.endswith("?") else "."
            if T is not None:
                i = worst_part(kinds, S, T, near)
                how = mistake.redone
                if np.isfinite(S[i]).all():  # of a NaN nobody says how far it is off
                    how = f"off by up to {kinds[i].apart(S[i], T[i])}; {how}"
                says += f" ({capitalised(how)} gives your numbers exactly.)"
            return Finding(mistake.slug, says)
    return None


def _made_again(
    redo: Callable[..., Any],
    arguments: tuple[Any, ...],
    kinds: Sequence[Any],
    S: Parts,
    first: int,
) -> Parts:
    """Return the answers with a mistake; none where the first is not the student's.

    Raises:
        ValueError: it has no answer to one of the questions.
    """
    if isinstance(redo, InTurn):
        again = parts(redo.nth(first, arguments))
        for s, a, kind in zip(S, again, kinds, strict=False):
            scale = kind.scale * max(1.0, largest(s, kind.scale))
            mine, its = as_one([s[first], a])
            if not matches(mine[None], its[None], scale):
                return ()
    return parts(redo(*arguments))


def redone(
    ask: Ask,
    arguments: tuple[Any, ...],
    S: Parts,
    T: Parts | None,
    further: Further | None = None,
) -> Finding | None:
    """Return a named mistake of the function, or a general one of its kind.

    Args:
        ask: the function's row.
        arguments: of the main questions, stacked.
        S: the student's answers.
        T: the right ones; None where many are right.
        further: fresh answers. Whole numbers that are equal prove little, so there a
            mistake has to give these as well, and must be the only one that does.
    """
    whole = any(kind.whole for kind in ask.kinds)
    if whole:
        found = _of_whole_numbers(ask, arguments, S, T, further)
    else:
        found = _named(ask.named, arguments, ask.kinds, S, T, ask.near)
    if found or T is None:
        return found
    if found := _in_another_order(ask, S, T):
        return found
    found = _general(ask, S, T)
    if found and whole and further:
        again = _general(ask, further.S, further.T)
        return found if again and again.slug == found.slug else None
    return found


def _in_another_order(ask: Ask, S: Parts, T: Parts) -> Finding | None:
    """Return that a function's results stand in another order, if so."""
    for order in permutations(range(len(T))):
        again = tuple(T[i] for i in order)
        if order != tuple(range(len(T))) and all_match(ask.kinds, S, again):
            names = [ask.kinds[i].called or f"result {i + 1}" for i in range(len(T))]
            says = f"The results are in another order; it is {', then '.join(names)}."
            return Finding("answers-swapped", says)
    return None


def _general(ask: Ask, S: Parts, T: Parts) -> Finding | None:
    """Return the mistake of its kind that gives the one part that is wrong."""
    for i, kind in enumerate(ask.kinds):
        if not all(matches(S[j], T[j]) for j in range(len(T)) if j != i):
            continue
        mine = (S[i],)
        its = (T[i],)
        if found := _named(kind.general(), its, [kind], mine, its, ask.near):
            called = f"{kind.called}: " if len(S) > 1 and kind.called else ""
            return Finding(found.slug, called + found.message)
    return None


def _of_whole_numbers(
    ask: Ask,
    arguments: tuple[Any, ...],
    S: Parts,
    T: Parts | None,
    further: Further | None,
) -> Finding | None:
    """Return the one or two mistakes that give all of the student's numbers."""
    found: dict[str, Finding] = {}
    for one in ask.named:
        first = _named([one], arguments, ask.kinds, S, T, ask.near)
        if first is None:
            continue
        if further:
            try:
                again = parts(one.redo(*further.arguments))
            except (ValueError, np.linalg.LinAlgError):
                continue
            if not all_match(ask.kinds, further.S, again):
                continue
        found.setdefault(one.slug, first)
    if len(found) == 2:
        either, other = found.values()
        says = f"Two mistakes give these numbers. Either: {either.message} Or: "
        return Finding(either.slug, says + other.message)
    return next(iter(found.values())) if len(found) == 1 else None


def two_at_once(case: Case, S: Parts, T: Parts) -> Finding | None:
    """Return two named mistakes that together give the student's answers, or None.

    Two terms that are wrong add up: what both make is the one answer and the other's
    difference from the right one. A mistake made with an argument comes before another,
    and one made with the finished answer after it.
    """
    ask = case.ask
    if any(kind.whole for kind in ask.kinds):
        return None
    i = int(np.argmax(gaps(ask.kinds, S, T)))
    mistakes = [one for one in ask.named if isinstance(one.redo, InTurn)][:MOST]
    answers = {}
    for k, one in enumerate(mistakes):
        answer = _answer(one, case.arguments, i, T)
        if _alike(ask, answer, _nth(T, i), MATCHES) is False:
            answers[k] = answer
    pairs = _Pairs(case, S, T, i, mistakes, answers)
    found = pairs.added() or pairs.finished() or pairs.in_turn()
    return _both_told(ask, found, S, T) if found else None


Pair = tuple[Mistake, Mistake]


@dataclass(frozen=True)
class _Pairs:
    """Pairs of mistakes beside a student's answers: one call's first, then all."""

    case: Case
    S: Parts  # the student's
    T: Parts  # the right ones
    i: int  # the call that is furthest off
    mistakes: Sequence[Mistake]
    answers: Mapping[int, Parts]  # to that call, of those that are wrong there

    def added(self) -> Pair | None:
        """Return two mistakes whose differences, or factors, come together."""
        its = _nth(self.T, self.i)
        for a, b in combinations(self.answers, 2):
            first = self.mistakes[a]
            second = self.mistakes[b]
            if first.slug == second.slug:
                continue
            pair = self.answers[a], self.answers[b]
            for combined in (_sum, _product):
                if not self._is_this_one(combined(*pair, its)):
                    continue
                one, other = (_all(x, self.case.arguments) for x in (first, second))
                if combined is _product and _one_factor(one, other, self.T):
                    continue
                if _alike(self.case.ask, combined(one, other, self.T), self.S):
                    return first, second
        return None

    def finished(self) -> Pair | None:
        """Return a mistake and another that is made with its finished answer."""
        if len(self.case.ask.kinds) != 1:
            return None
        general = list(self.case.ask.kinds[0].general())
        its = _nth(self.T, self.i)
        for n, change in enumerate(general):
            for k, answer in self.answers.items():
                if self._is_this_one(_changed(change, answer)):
                    every = _all(self.mistakes[k], self.case.arguments)
                    if _alike(self.case.ask, _changed(change, every), self.S):
                        return self.mistakes[k], change
            for first in general[:n]:
                if self._is_this_one(_changed(change, _changed(first, its))):
                    every = _changed(change, _changed(first, self.T))
                    if _alike(self.case.ask, every, self.S):
                        return first, change
        return None

    def in_turn(self) -> Pair | None:
        """Return a mistake made with an argument and one after it, or two options."""
        for pair in _that_combine(self.mistakes):
            if self._is_this_one(_answer(pair, self.case.arguments, self.i, self.T)):
                every = _all(pair, self.case.arguments)
                if _alike(self.case.ask, every, self.S):
                    return pair
        return None

    def _is_this_one(self, answer: Parts) -> bool:
        return bool(_alike(self.case.ask, answer, _nth(self.S, self.i)))


def _that_combine(mistakes: Sequence[Mistake]) -> Iterator[Pair]:
    """Yield pairs that can be made together.

    The first is made with an argument, or both are one function's with other options,
    as `partial` gives them.
    """
    for i, first in enumerate(mistakes):
        one: Any = first.redo
        for k, second in enumerate(mistakes):
            other: Any = second.redo
            given = hasattr(one.function, "given")
            if first.slug != second.slug and (
                given or (i < k and _options(one.function, other.function))
            ):
                yield first, second


def _options(one: Any, other: Any) -> bool:
    """Return whether two are the same function with different options."""
    if not (isinstance(one, partial) and isinstance(other, partial)):
        return False
    return one.func is other.func and not one.keywords.keys() & other.keywords.keys()


def _together(one: Any, other: Any) -> Callable[..., Any]:
    """Return a function with two mistakes."""
    if hasattr(one, "given"):
        return lambda *args: other(*one.given(*args))
    return partial(one, **other.keywords)


def _answer(
    one: Mistake | Pair, arguments: tuple[Any, ...], i: int, like: Parts
) -> Parts:
    """Return the answer to one question with a mistake, or with two; () for none.

    It is filled up with 0 to the size of `like`, as answers of several sizes are.
    """
    column = [c[[i]] if isinstance(c, np.ndarray) else c for c in arguments]
    answer = _nth(_all(one, tuple(column)), 0)
    pairs = list(zip(answer, like, strict=False))
    if any(x.ndim != its.ndim for x, its in pairs):
        return answer
    return tuple(as_one([x[0], np.zeros(its.shape[1:])])[:1] for x, its in pairs)


def _all(one: Mistake | Pair, arguments: tuple[Any, ...]) -> Parts:
    try:
        if isinstance(one, Mistake):
            return parts(one.redo(*arguments))
        first: Any = one[0].redo
        second: Any = one[1].redo
        function = _together(first.function, second.function)
        return parts(InTurn(function)(*arguments))
    except (ValueError, np.linalg.LinAlgError):
        return ()


def _changed(change: Mistake, answer: Parts) -> Parts:
    """Return an answer with a mistake that is made when it is finished."""
    try:
        return parts(change.redo(answer[0])) if answer else ()
    except (ValueError, np.linalg.LinAlgError):
        return ()


def _nth(some: Parts, i: int) -> Parts:
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


def _alike(ask: Ask, a: Parts, b: Parts, within: float = EXACT) -> bool | None:
    """Return whether two answers match; None where there is none."""
    if len(a) != len(b):
        return None
    return all_match(ask.kinds, a, b, within)


def _both_told(ask: Ask, pair: Pair, S: Parts, T: Parts) -> Finding:
    i = worst_part(ask.kinds, S, T, ask.near)
    says = "; ".join(_BUT.sub("", one.says.rstrip("?")) for one in pair)
    off = f"Off by up to {ask.kinds[i].apart(S[i], T[i])}"
    how = f"{off}; both together give your numbers exactly"
    slug = "+".join(one.slug for one in pair)
    return Finding(slug, f"Two things at once: {says}. ({how}.)")
