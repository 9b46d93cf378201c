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
    largest,
    matches,
    parts,
    worst_part,
)
from labkit.judge.ask import Ask, Further
from labkit.judge.mistake import Finding, Mistake


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
                    how = f"{kinds[i].gap} {kinds[i].apart(S[i], T[i])}; {how}"
                says += f" ({capitalised(how)} reproduces your output.)"
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
