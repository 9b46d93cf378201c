"""A named mistake made again: it is claimed where that gives the student's numbers."""

from collections.abc import Callable, Sequence
from itertools import permutations
from typing import Any

import numpy as np

from labkit.judge.answers import (
    InTurn,
    Parts,
    all_match,
    as_one,
    capitalised,
    gaps,
    parts,
    worst_part,
)
from labkit.judge.ask import Ask, Further
from labkit.judge.hypothesis import equals, evidence, explained, explains
from labkit.judge.mistake import Finding, Mistake


def _named(
    mistakes: Sequence[Mistake],
    arguments: tuple[Any, ...],
    ask: Ask,
    S: Parts,
    T: Parts | None,
) -> Finding | None:
    """Return the first mistake that, made on purpose, explains the answers."""
    first = -1 if T is None else int(np.argmax(gaps(ask.kinds, S, T)))
    for mistake in mistakes:
        try:
            again = _made_again(mistake.redo, arguments, ask, S, T, first)
        except (ValueError, np.linalg.LinAlgError):  # it has no answer of its own here
            continue
        if T is None and all_match(ask.kinds, S, again):
            return Finding(mistake.slug, _sentence(mistake))
        if T is not None and explains(ask, S, T, again):
            exact = equals(ask.kinds, S, again)
            return Finding(mistake.slug, _with_evidence(mistake, ask, S, T, exact))
    return None


def _sentence(mistake: Mistake) -> str:
    says = capitalised(mistake.says)
    return says + ("" if says.endswith("?") else ".")


def _with_evidence(mistake: Mistake, ask: Ask, S: Parts, T: Parts, exact: bool) -> str:
    """Return what is said of a mistake, and how well it explains the answers."""
    i = worst_part(ask.kinds, S, T, ask.near)
    how = mistake.redone
    if np.isfinite(S[i]).all():  # of a NaN nobody says how far it is off
        how = f"{ask.kinds[i].gap} {ask.kinds[i].apart(S[i], T[i])}; {how}"
    return f"{_sentence(mistake)} ({capitalised(how)} {evidence(exact)}.)"


def _made_again(
    redo: Callable[..., Any],
    arguments: tuple[Any, ...],
    ask: Ask,
    S: Parts,
    T: Parts | None,
    first: int,
) -> Parts:
    """Return the answers with a mistake; none where the first is not the student's.

    Raises:
        ValueError: it has no answer to one of the questions.
    """
    if isinstance(redo, InTurn):
        again = parts(redo.nth(first, arguments))
        mine = tuple(s[first : first + 1] for s in S)
        pairs = list(zip(again, mine, strict=False))
        if any(a.ndim != s.ndim - 1 for a, s in pairs):
            return ()
        whole = [as_one([a, np.zeros(s.shape[1:])])[:1] for a, s in pairs]
        its = tuple(t[first : first + 1] for t in T) if T is not None else mine
        if not explained(ask, mine, its, tuple(whole)).all():
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
        found = _named(ask.named, arguments, ask, S, T)
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
        if order != tuple(range(len(T))) and explains(ask, S, T, again):
            names = [ask.kinds[i].called or f"result {i + 1}" for i in range(len(T))]
            says = f"The results are in another order; it is {', then '.join(names)}."
            return Finding("answers-swapped", says)
    return None


def _general(ask: Ask, S: Parts, T: Parts) -> Finding | None:
    """Return the mistake of its kind that gives the one part that is wrong."""
    for i, kind in enumerate(ask.kinds):
        for one in kind.general():
            try:
                again = (*T[:i], np.asarray(one.redo(T[i])), *T[i + 1 :])
            except (ValueError, np.linalg.LinAlgError):  # it has no answer here
                continue
            if explains(ask, S, T, again):
                exact = equals(ask.kinds, S, again)
                called = f"{kind.called}: " if len(S) > 1 and kind.called else ""
                says = called + _with_evidence(one, ask, S, T, exact)
                return Finding(one.slug, says)
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
        first = _named([one], arguments, ask, S, T)
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
