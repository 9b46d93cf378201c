"""A named mistake that stops, or returns another shape, at some of the questions.

Such answers cannot be laid beside the right ones entry by entry, so the mistake is
made again call by call: it is claimed where it stops in the calls in which the
student's function stops, with the same exception, and gives the same arrays elsewhere.
Without a name, such arrays may still hold the right entries in another order.
"""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from labkit.base.exchange import Exchange
from labkit.judge import results
from labkit.judge.answers import InTurn, Parts, capitalised, listed, matches, parts
from labkit.judge.ask import Ask, Asked, stacked
from labkit.judge.hypothesis import evidence
from labkit.judge.matrix_kinds import SWAPPED
from labkit.judge.mistake import Finding, Mistake
from robo47.checks import Array

SAME, TRANSPOSED, RESHAPED, MIXED = "same", "transposed", "reshaped", "mixed"
AGREE = 2  # answers that have to be the same besides what stops
Answer = Parts | str  # to one question, or the name of the exception


def named(asked: Asked, found: Finding) -> Finding:
    """Return the mistake that gives answers of these shapes, or what was found.

    Args:
        asked: the questions, with replies that are arrays of other shapes.
        found: what is said of the shapes.
    """
    mine = [_given(one, asked.ask) for one in asked.main]
    if any(isinstance(one, str) for one in mine):
        return found
    return _first(asked, mine, found, evidence(True))


def stops_alike(asked: Asked, found: Finding) -> Finding:
    """Return the mistake that stops in the same calls, or what was found.

    Args:
        asked: the questions; some replies are exceptions, the others are right.
        found: what is said of the exceptions.
    """
    mine = [_given(one, asked.ask) for one in asked.main]
    stops = sum(isinstance(one, str) for one in mine)
    if not stops or len(mine) - stops < AGREE:
        return found
    return _first(asked, mine, found, f"stops in the same call{'s' * (stops > 1)}")


def _first(asked: Asked, mine: Sequence[Answer], found: Finding, how: str) -> Finding:
    arguments = stacked(asked.main)
    for mistake in asked.ask.named:
        if isinstance(mistake.redo, InTurn):
            again = _again(mistake, arguments, len(mine))
            if len(again) == len(mine) and all(map(_same, mine, again)):
                says = f"{capitalised(mistake.says)}. {found.message} "
                says += f"{capitalised(mistake.does(how))}."
                return Finding(mistake.slug, says)
    return found


def in_another_order(asked: Asked, found: Finding) -> Finding:
    """Return what was found, and that all entries are right where only they moved.

    It is said only if it is so in all calls, the fresh ones as well.

    Args:
        asked: the questions, with replies that are arrays of other shapes.
        found: what is said of the shapes.
    """
    truth = asked.ask.truth
    if not isinstance(truth, InTurn):
        return found
    exchanges = [*asked.main, *asked.fresh]
    right = map(parts, truth.each(stacked(exchanges)))
    moved: dict[int, set[str]] = {}  # how each result that is wrong may have moved
    telling = 0
    for one, its in zip(exchanges, right, strict=True):
        mine = _given(one, asked.ask)
        if isinstance(mine, str) or len(mine) != len(its):
            return found
        how = [_moved(a, b) for a, b in zip(mine, its, strict=True)]
        if not all(how):
            return found
        off = [j for j, ways in enumerate(how) if SAME not in ways]
        telling += any(len(set(its[j].ravel().tolist())) > 1 for j in off)
        for j in off:
            moved[j] = moved.get(j, how[j]) & how[j]
    known = SWAPPED in found.message  # that they are transposed
    if telling < AGREE or known:
        return found
    return Finding(found.slug, f"{found.message} {_in_words(asked.ask, moved)}")


def _moved(mine: Array, its: Array) -> set[str]:
    """Return how an array may differ whose entries are the right ones."""
    if mine.size != its.size:
        return set()
    pairs = {
        SAME: (mine, its),
        TRANSPOSED: (mine, its.T),
        RESHAPED: (mine, its.reshape(mine.shape)),
        MIXED: (np.sort(mine, axis=None), np.sort(its, axis=None)),
    }
    return {
        how
        for how, (one, other) in pairs.items()
        if one.shape == other.shape and matches(one[None], other[None])
    }


def _in_words(ask: Ask, moved: Mapping[int, set[str]]) -> str:
    """Return what happened to the results whose entries moved, by their places."""
    ways = set.intersection(*moved.values())
    names = [ask.kinds[j].called for j in moved if len(ask.kinds) > 1]
    which = listed(names) if names and all(names) else "the result"
    if TRANSPOSED in ways:
        verb = "is" if len(names) < 2 else "are"
        return f"All entries are right, but {which} {verb} transposed."
    if RESHAPED in ways:
        return "All entries and their order are right. Only the shape is wrong."
    return f"All entries are right, but their order is wrong in {which}."


def _again(mistake: Mistake, arguments: tuple[Any, ...], n: int) -> list[Answer]:
    """Return the answers with a mistake, or the names of what it stops with."""
    redo = mistake.redo
    assert isinstance(redo, InTurn)
    found: list[Answer] = []
    for i in range(n):
        try:
            found.append(parts(redo.nth(i, arguments)))
        except ValueError as error:
            found.append(type(error.__cause__ or error).__name__)
    return found


def _given(one: Exchange, ask: Ask) -> Answer:
    """Return a student's answer as arrays, or the name of its exception."""
    assert one.reply
    if one.reply.kind:
        return one.reply.kind
    values = results.split(ask.kind, one.reply.value)
    if isinstance(values, Finding):
        return values.slug
    try:
        pairs = zip(ask.kinds, values, strict=True)
        return tuple(kind.numbers(value) for kind, value in pairs)
    except (TypeError, ValueError):
        return "not-numbers"


def _same(mine: Answer, again: Answer) -> bool:
    if isinstance(mine, str) or isinstance(again, str):
        return mine == again
    pairs = zip(mine, again, strict=False)
    alike = (a.shape == b.shape and matches(a[None], b[None]) for a, b in pairs)
    return len(mine) == len(again) and all(alike)
