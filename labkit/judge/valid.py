"""Answers that differ from the reference's and have the property that is asked for."""

from collections.abc import Sequence

import numpy as np

from labkit.base.exchange import Exchange
from labkit.judge import results
from labkit.judge.answers import Parts, own
from labkit.judge.ask import Ask, Asked, as_plain, right_answers
from robo47.checks import Array


def taken(ask: Ask, exchanges: Sequence[Exchange], S: Parts) -> Parts:
    """Return the answers, with the reference's in the place of each valid one.

    Where the docstring asks for a method, an answer of another one stays what it is.

    Args:
        ask: the function's row.
        exchanges: the questions, with their replies.
        S: the answers, read from these.
    """
    if not ask.valid or ask.method:
        return S
    T = right_answers(ask, exchanges)
    if any(s.shape != t.shape for s, t in zip(S, T, strict=True)):
        return S
    S = tuple(map(np.copy, S))
    for k in np.flatnonzero(ask.gaps(S, T) > ask.tolerance).tolist():
        if _has(ask, exchanges[k], [part[k] for part in S]):
            for mine, its in zip(S, T, strict=True):
                mine[k] = its[k]
    return S


def by_another_method(asked: Asked) -> bool:
    """Return whether no answer lacks the property where the reference's has it.

    In half of these calls, and two, it must have it: of others it may not decide.
    """
    ask = asked.ask
    if not ask.valid or not ask.method:
        return False
    found = []
    for one in (*asked.main, *asked.fresh):
        right = [part[0] for part in right_answers(ask, [one])]
        if _has(ask, one, right):
            mine = results.read(ask.kind, [one.reply.value if one.reply else None])
            there = isinstance(mine, list) and _has(ask, one, [x[0] for x in mine])
            if there is False:
                return False
            found.append(bool(there))
    return sum(found) > 1 and 2 * sum(found) >= len(found)


def _has(ask: Ask, one: Exchange, answer: list[Array]) -> bool | None:
    """Return whether an answer, by its parts, has the property that is asked for."""
    assert ask.valid
    arguments = map(own, map(as_plain, one.question.args))
    has = ask.valid(*arguments, results.as_sent(ask.kind, answer))
    return None if has is None else bool(has)
