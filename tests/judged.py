"""Answers put before the judge as a student's function would give them."""

import numpy as np

from labkit.base.exchange import Reply
from labkit.judge.answers import InTurn, as_one, gaps, matches, parts
from labkit.judge.ask import (
    asked_of,
    right_answers,
    stacked,
)
from labkit.judge.judge import judge
from labkit.judge.mistake import Finding
from labkit.judge.replies_read import read
from labkit.judge.results import as_sent

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


def replies_of(values, sizes=(), kind=None):
    """Return replies with these answers, per part (n, ...), twice the same.

    Where their size follows the question it is `sizes`; of a kind they are what a
    function returns, such as an index.
    """
    columns = parts(values) if isinstance(values, tuple) else (np.asarray(values),)
    found = []
    for i, row in enumerate(zip(*columns, strict=True)):
        row = [cut(x, sizes[i][k]) for k, x in enumerate(row)] if sizes else row
        if kind is not None:
            value = as_sent(kind, list(map(np.asarray, row)))
            found.append(Reply(value=value, again=value))
            continue
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
    return judged_replies(ask, replies_of(values, sizes, ask.kind), source)


def judged_replies(ask, replies, source=""):
    """Return the verdict on replies to the main questions, the rest being right.

    Fresh questions have no answer where a main one is wrong: a function that is wrong
    there is not right elsewhere.
    """
    asked = round_of(ask)
    answered(asked.main, replies)
    if asked.fresh and not _all_right(asked):
        answered(asked.fresh, [NONE] * len(asked.fresh))
    elif asked.fresh:
        sizes = sizes_of(ask, asked.fresh)
        fresh = right_answers(ask, asked.fresh)
        answered(asked.fresh, replies_of(fresh, sizes, ask.kind))
    for held, exchanges in zip(ask.held_out, asked.held_out, strict=True):
        answers = [NONE] * len(exchanges)
        if not held.mistaken:
            sizes = sizes_of(ask, exchanges)
            right_ones = right_answers(ask, exchanges, held)
            answers = replies_of(right_ones, sizes, ask.kind)
        answered(exchanges, answers)
    answered(asked.probes, [NONE] * len(asked.probes))
    return judge(asked, source)


def _all_right(asked):
    S = read(asked.main, asked.ask)
    if isinstance(S, Finding):
        return True  # what is said then is not of numbers
    off = asked.ask.gaps(S, right_answers(asked.ask, asked.main))
    return bool(off.max() <= asked.ask.near)


def redone(ask):
    """Return (mistake, its answers) for each that differs from the right answer.

    The answers are one array per call and part, None for a call at which it stops.
    """
    arguments, T = stacked(round_of(ask).main), right(ask)
    found = []
    for mistake in ask.named:
        with np.errstate(all="ignore"):
            S = call_by_call(mistake.redo, arguments, len(T[0]))
            answers = [one for one in S if one is not None]
            if answers and differs(ask, S, T):
                found.append((mistake, S))
    return found


def call_by_call(redo, arguments, n):
    """Return a mistake's answers; None where it stops, as a student's may."""
    try:
        whole = parts(redo(*arguments))
        return [tuple(part[i] for part in whole) for i in range(n)]
    except (ValueError, np.linalg.LinAlgError):
        if not isinstance(redo, InTurn):
            return [None] * n
    found = []
    for i in range(n):
        try:
            found.append(parts(redo.nth(i, arguments)))
        except (ValueError, np.linalg.LinAlgError):
            found.append(None)
    return found


def differs(ask, S, T):
    """Return whether answers stop, have another shape or are off at some call."""
    for i, mine in enumerate(S):
        its = tuple(part[i] for part in T)
        if mine is None or [x.ndim for x in mine] != [x.ndim for x in its]:
            return True
        one = (tuple(x[None] for x in some) for some in (mine, its))
        if gaps(ask.kinds, *one, ask.rtol).max() > ask.near:
            return True
    return False


def alike(S_a, S_b):
    """Return whether two mistakes stop at the same calls and are alike elsewhere."""
    if [one is None for one in S_a] != [one is None for one in S_b]:
        return False
    columns = [list(zip(*filter(None, S), strict=True)) for S in (S_a, S_b)]
    try:
        pairs = list(zip(*columns, strict=True))
        return all(matches(as_one(x), as_one(y)) for x, y in pairs)
    except ValueError:  # of other shapes
        return False


def moved(column, off):
    """Return an argument of all calls moved a little; a truth value or index stays."""
    if not isinstance(column, np.ndarray):
        return column
    if column.dtype == object:
        found = np.empty(len(column), dtype=object)
        for at, one in enumerate(column):
            plain = isinstance(one, float) or getattr(one, "dtype", None) == np.float64
            found[at] = one + off if plain else one
        return found
    return column + off if column.dtype.kind == "f" else column
