"""A named mistake that stops, or returns another shape, at some of the questions.

Such answers cannot be laid beside the right ones entry by entry, so the mistake is
made again call by call: it is claimed where it stops in the calls in which the
student's function stops, with the same exception, and gives the same arrays elsewhere.
"""

from collections.abc import Sequence
from typing import Any

from labkit.base.exchange import Exchange
from labkit.judge import results
from labkit.judge.answers import InTurn, Parts, capitalised, matches, parts
from labkit.judge.ask import Ask, Asked, stacked
from labkit.judge.hypothesis import evidence
from labkit.judge.mistake import Finding, Mistake

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
