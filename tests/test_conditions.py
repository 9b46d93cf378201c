"""Every condition that is printed of a wrong function is true of 100 fresh inputs.

The functions are wrong in a part of the calls alone, or are those of a day's catalogue,
whose names are not looked for here.
"""

import functools
import itertools
import re

import numpy as np
import pytest
from cpu_limit import ended_late

from conftest import days
from labkit.base.exchange import Exchange, Question, Reply
from labkit.judge.answers import own
from labkit.judge.ask import as_plain, asked_of
from labkit.judge.cases import CLOSE, NONE, RIGHT, WRONG, in_cases, of_call, verdict
from labkit.judge.draw import Draw
from labkit.judge.guard import quiet
from labkit.judge.neutral import neutrals
from labkit.judge.right_when import QUESTIONS, experiments
from labkit.judge.row import rows_of
from labkit.sandbox.inside import wire

FRESH = 100
SEED = 90210  # of fresh inputs: no check asks these
SECONDS = 2.0  # of the processor, for one call

pytestmark = pytest.mark.kit


def reply(function, args):
    """Return the reply of a function, whose answer travels as a student's does."""
    try:
        with ended_late(SECONDS), np.errstate(all="ignore"):
            value = function(*map(own, map(as_plain, args)))
        value = wire.unpack_value(wire.pack_value(value))
    except Exception as error:
        return Reply(kind=type(error).__name__, error=str(error))
    return Reply(value=value, again=value)


def phrases_in(text, phrases):
    """Yield the phrases of a list; the longest first, as one may hold another."""
    for phrase in sorted(phrases, key=len, reverse=True):
        if phrase in text:
            text = text.replace(phrase, "")
            yield phrase


TOLD = {
    RIGHT: r"(?:is correct for|Correct:) ",
    WRONG: r"(?:It is wrong in every test for|Wrong in every test:) ",
    "only": r"wrong(?:, but)? only for ",
}
END = re.compile(r"\.(?:\s|$)|, and sometimes wrong ")


def lists_in(says):
    """Yield the lists of cases in a sentence, each with its status."""
    for status, words in TOLD.items():
        _, *rest = re.split(words, says, maxsplit=1)
        for some in rest:
            yield status, END.split(some)[0]


def test_a_condition_is_read_from_each_form_of_the_sentence():
    says = "The result is correct for a. "
    says += "It is wrong in every test for b, and sometimes wrong for c."
    assert dict(lists_in(says)) == {RIGHT: "a", WRONG: "b"}
    says = "Correct: a; b. Wrong in every test: c; d. Sometimes wrong: e."
    assert dict(lists_in(says)) == {RIGHT: "a; b", WRONG: "c; d"}
    for says in ("wrong only for a.", "sometimes wrong, but only for a."):
        assert dict(lists_in(f"The result is {says}")) == {"only": "a"}


def printed(row, function):
    """Yield each condition of a wrong function: its words, what holds, its status.

    And which argument it is about, -1 for the whole call.
    """
    ask = row.ask
    asked = asked_of("1.1", row.function, ask, seed=3)
    for one in asked.exchanges:
        one.reply = reply(function, one.question.args)
    wrong = [i for i, one in enumerate(asked.main) if verdict(ask, one) == WRONG]
    if not wrong or ask.truth is None:
        return

    def answers(questions):
        return [reply(function, one.args) for one in questions]

    by_phrase = {says: of for some in ask.cases for says, of in some.items()}
    says = in_cases(asked, answers)
    for status, some in lists_in(says):
        for phrase in phrases_in(some, by_phrase):
            yield phrase, functools.partial(of_call, by_phrase[phrase]), status, -1
    if not says:
        tried = experiments(asked, wrong[-QUESTIONS:], row.arguments, answers)
        for claim in tried.tested():
            yield claim.says, claim.holds, RIGHT, claim.k


@functools.cache
def fresh(row):
    """Return fresh calls of a row, those of rare cases too, for all its conditions.

    In any order: the first ones of each round may have always the same sizes.
    """
    calls = list(itertools.islice(_fresh(row), 40 * FRESH))
    return [calls[i] for i in np.random.default_rng(SEED).permutation(len(calls))]


def _fresh(row):
    for n in range(400):
        rng = [SEED, n]
        drawn = row.ask.drawn
        yield from [tuple(c) for c in row.ask.inputs(Draw(rng))][-drawn:] * bool(drawn)
        for draw in row.ask.rare:
            yield from map(tuple, draw(Draw(rng)))


def that_hold(row, holds, says, k):
    """Yield fresh calls of which a condition is true, made so where they are not."""
    for call in fresh(row):
        if holds(call):
            yield call
        elif k >= 0:
            name = row.arguments[k]
            for one in neutrals(call[k]):
                if says == f"whenever {one.says.format(name)}":
                    yield (*call[:k], one.value, *call[k + 1 :])


def counterexamples(row, function, says, holds, status, k):
    """Return how many of 100 fresh inputs contradict a condition.

    What was wrong in every test is contradicted only where no other input is wrong.
    """
    if status == "only":
        calls = (c for c in fresh(row) if not holds(c))
        status = RIGHT
    else:
        calls = that_hold(row, holds, says, k)
    calls = (call for call in calls if definite(row, call))
    against, tried = 0, list(itertools.islice(calls, FRESH))
    for call in tried:
        one = Exchange(Question("", "", call), reply(function, call))
        against += verdict(row.ask, one) not in (status, CLOSE, NONE)
    return against if status == RIGHT or against == len(tried) else 0


def definite(row, call):
    """Return whether a call has one right answer: not if rounding decides it."""
    if row.ask.at_edge and not of_call(row.ask.at_edge, call):
        return False
    near = tuple(1.0000000001 * x if isinstance(x, np.ndarray) else x for x in call)
    one = Exchange(Question("", "", call), reply(row.truth, near))
    return verdict(row.ask, one) in (RIGHT, CLOSE, NONE)


def twisted(answer):
    """Return another answer of the same kind."""
    if isinstance(answer, tuple):
        return tuple(map(twisted, answer))
    if answer is None:
        return None
    if isinstance(answer, bool | np.bool_):
        return not answer
    if isinstance(answer, int | np.integer):
        return answer
    return 1.5 * np.asarray(answer) + 0.1


def first(arg):
    """Return the first number of an argument, None where it has none."""
    numbers = np.ravel(arg) if isinstance(arg, float | np.ndarray) else ()
    return float(numbers[0]) if len(numbers) else None


def wrong_in_part(row):
    """Yield functions that are wrong where one number of a call is small, or large."""
    for k in range(len(row.arguments)):
        given = [
            call[k] for call in row.ask.main if k < len(call)
        ]  # one may be left out
        column = [x for arg in given if (x := first(arg)) is not None]
        if len(set(column)) < 5:
            continue
        for low in (True, False):
            limit = float(np.quantile(np.abs(column), 0.3 if low else 0.7))

            def code(*args, k=k, low=low, limit=limit):
                answer = row.truth(*args)
                x = first(args[k]) if k < len(args) else None
                return twisted(answer) if (abs(x or 0.0) <= limit) is low else answer

            yield f"{row.arguments[k]} {'small' if low else 'large'}", code


def traits(row, call):
    """Return by name the sizes and the sums of a call's arguments."""
    found = {}
    for name, x in zip(row.arguments, call, strict=False):
        if isinstance(x, np.ndarray) and x.dtype.kind in "fiub":
            found |= {f"axis {i} of {name}": float(n) for i, n in enumerate(x.shape)}
            found[f"sum of {name}"] = float(x[np.isfinite(x)].sum())
    return found


def wrong_at_an_end(row):
    """Yield functions that are wrong where a trait of a call is low, or high."""
    table = [traits(row, call) for call in row.ask.main]
    for name in sorted(set().union(*table)):
        column = [known[name] for known in table if name in known]
        if len(set(column)) < 3:
            continue
        for low, share in itertools.product((True, False), (0.1, 0.5, 0.9)):
            limit = float(np.quantile(column, share))

            def code(*args, name=name, low=low, limit=limit):
                answer = row.truth(*args)
                x = traits(row, args).get(name, 0.0)
                return twisted(answer) if (x <= limit) is low else answer

            yield f"{name} {'<=' if low else '>'} {limit:g}", code


def false_ones(row, some):
    """Return the conditions of some wrong functions that are not true, and how many."""
    found, said = [], 0
    with quiet():
        for what, code in some:
            for says, holds, status, k in printed(row, code):
                said += 1
                if n := counterexamples(row, code, says, holds, status, k):
                    found.append(f"{row.function}, {what}: {status}: {says}: {n}")
    return found, said


DAYS = days()
QUICK = {1: "quat_to_R", 5: "error_response", 9: "low_pass", 11: "box_sdf",
         12: "steer"}  # fmt: skip


def test_a_call_without_an_end_is_ended(monkeypatch):
    monkeypatch.setitem(globals(), "SECONDS", 0.05)

    def endless():
        while True:
            pass

    assert reply(endless, ()).kind == "TimeoutError"


@pytest.mark.parametrize("number", QUICK)
def test_what_is_printed_of_a_part_that_is_wrong_is_true(number):
    day = next(day for day in DAYS if day.number == number)
    row = rows_of(day)[QUICK[number]]
    found, _ = false_ones(row, wrong_in_part(row))
    assert not found


@pytest.mark.soak
@pytest.mark.parametrize("day", DAYS, ids=lambda day: f"day{day.number}")
def test_all_that_is_printed_of_a_day_is_true(day):
    found, said = [], 0
    for row in rows_of(day).values():
        ways = [(way.slug, way.code) for way in row.ways if way.status == "wrong"]
        ways = ways[:: max(1, len(ways) // 12)]
        false, n = false_ones(row, [*wrong_in_part(row), *wrong_at_an_end(row), *ways])
        found += false
        said += n
    print(f"day {day.number}: {said} conditions, {len(found)} false")
    assert not found, "\n".join(found)
