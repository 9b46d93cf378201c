"""Answers put before the judge as a student's function would give them."""

import numpy as np

from labkit.base.exchange import Reply
from labkit.judge.answers import InTurn, parts
from labkit.judge.ask import (
    asked_of,
    right_answers,
    stacked,
)
from labkit.judge.judge import judge

FRESH_SEED = 4711
NONE = Reply(kind="TypeError", error="no such argument")


def round_of(ask, function="f"):
    """Return the questions of one row, as a check asks them."""
    return asked_of("1.1", function, ask, FRESH_SEED)


def right(ask):
    """Return the right answers to the main questions: per part, (n, ...)."""
    return right_answers(ask, round_of(ask).main)


def sizes_of(ask, exchanges):
    """Return the shapes of the right answers where they follow the question, or []."""
    if not isinstance(ask.truth, InTurn) or all(None not in k.shape for k in ask.kinds):
        return []
    arguments = stacked(exchanges)
    each = map(parts, ask.truth.each(arguments))
    return [[np.shape(part) for part in one] for one in each]


def cut(answer, shape):
    """Return an answer without what filled it up to the size of the largest."""
    return answer[tuple(map(slice, shape))]


def replies_of(values, sizes=()):
    """Return replies with these answers, per part (n, ...), twice the same.

    Where their size follows the question it is `sizes`.
    """
    columns = parts(values) if isinstance(values, tuple) else (np.asarray(values),)
    found = []
    for i, row in enumerate(zip(*columns, strict=True)):
        row = [cut(x, sizes[i][k]) for k, x in enumerate(row)] if sizes else row
        value = row[0] if len(row) == 1 else tuple(np.asarray(part) for part in row)
        value = np.asarray(value) if len(row) == 1 else value
        found.append(Reply(value=value, again=value))
    return found


def answered(exchanges, replies):
    """Give each question its reply."""
    for exchange, reply in zip(exchanges, replies, strict=True):
        exchange.reply = reply


def judged(ask, values, source=""):
    """Return the verdict on main answers; all further questions are answered right."""
    sizes = sizes_of(ask, round_of(ask).main)
    return judged_replies(ask, replies_of(values, sizes), source)


def judged_replies(ask, replies, source=""):
    """Return the verdict on replies to the main questions, the rest being right."""
    asked = round_of(ask)
    answered(asked.main, replies)
    if asked.fresh:
        sizes = sizes_of(ask, asked.fresh)
        answered(asked.fresh, replies_of(right_answers(ask, asked.fresh), sizes))
    for held, exchanges in zip(ask.held_out, asked.held_out, strict=True):
        answers = [NONE] * len(exchanges)
        if not held.mistaken:
            sizes = sizes_of(ask, exchanges)
            answers = replies_of(right_answers(ask, exchanges, held), sizes)
        answered(exchanges, answers)
    answered(asked.probes, [NONE] * len(asked.probes))
    return judge(asked, source)
