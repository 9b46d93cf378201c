"""Answers put before the judge as a student's function would give them."""

import numpy as np

from labkit.judge.exchange import Reply
from labkit.judge.judging import judge
from labkit.judge.rounds import held_out_answers, make_round, parts, right_answers

FRESH_SEED = 4711


def round_of(ask, function="f"):
    """Return the questions of one row, as a check asks them."""
    return make_round("1.1", function, ask, FRESH_SEED)


def right(ask):
    """Return the right answers to the main questions: per part, (n, ...)."""
    return right_answers(ask, round_of(ask).main)


def replies_of(values, ask):
    """Return replies with these answers, per part (n, ...), twice the same."""
    columns = parts(values) if isinstance(values, tuple) else (np.asarray(values),)
    found = []
    for row in zip(*columns, strict=True):
        value = row[0] if len(row) == 1 else tuple(np.asarray(part) for part in row)
        value = np.asarray(value) if len(row) == 1 else value
        found.append(Reply(value=value, again=value))
    return found


def judged(ask, values, source=""):
    """Return the verdict on main answers; all further questions are answered right."""
    asked = round_of(ask)
    return judge(asked, [*replies_of(values, ask), *rest_of(asked)], source)


def judged_replies(ask, replies, source=""):
    """Return the verdict on replies to the main questions."""
    asked = round_of(ask)
    return judge(asked, [*replies, *rest_of(asked)], source)


def rest_of(asked):
    """Return right replies to all but the main questions; no answer to a probe."""
    ask = asked.ask
    found = replies_of(right_answers(ask, asked.fresh), ask) if asked.fresh else []
    for held, questions in zip(ask.held_out, asked.held_out, strict=True):
        if held.mistaken:
            found += [Reply(kind="TypeError", error="no such argument")] * len(
                questions
            )
        else:
            found += replies_of(held_out_answers(held, ask, questions), ask)
    return found + [Reply(kind="TypeError")] * len(asked.probes)
