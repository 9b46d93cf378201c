"""The judge on the days' questions: each mistake is found, none is claimed unduly.

All functions of a day that has changed, of the others one for each kind of answer:
`whole.py`.
"""

import contextlib

import inprocess
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from judged import alike, judged, moved, redone, right, round_of
from whole import changed, one_of_each

from conftest import days
from labkit.base.exchange import Exchange, Question
from labkit.judge.answers import InTurn, difference, gaps, parts
from labkit.judge.ask import stacked
from labkit.judge.row import rows_of
from labkit.judge.typed import typed
from labkit.lesson.day import find_day
from labkit.lesson.lab_module import lab_of
from robo47.errors import Robo47Error

pytestmark = pytest.mark.kit


def rows(day):
    """Return (function, its questions, slugs that are one thing) of a day."""
    return [(name, row.ask, row.alike) for name, row in rows_of(day).items()]


@pytest.fixture(scope="module", autouse=True)
def _once():
    with inprocess.worked_out_once():
        yield


ALIKE = {(d.number, name): alike for d in days() for name, _, alike in rows(d)}
CHANGED = {day.number for day in days() if changed(day)}


def param(day, name, ask):
    return pytest.param(day.number, name, ask, id=f"day{day.number}/{name}")


def kinds_of(row):
    """Return the kinds of a function's answer, and how it is judged."""
    ask = row.values[2]
    kinds = [type(kind).__name__ for kind in ask.kinds]
    return (*kinds, ask.truth is None, ask.accept is None)


EVERY = [param(day, name, ask) for day in days() for name, ask, _ in rows(day)]
ROWS = [row for row in EVERY if row.values[0] in CHANGED]
ROWS += one_of_each([row for row in EVERY if row not in ROWS], kinds_of)
WITH_TRUTH = [row for row in ROWS if row.values[2].truth]
every = pytest.mark.parametrize(("number", "name", "ask"), WITH_TRUTH)


@every
def test_the_library_gives_all_questions_at_once_what_it_gives_each(number, name, ask):
    held_out = zip(round_of(ask).held_out, ask.held_out, strict=True)
    rounds = [some for some, held in held_out if not held.mistaken]
    for exchanges in (round_of(ask).main, round_of(ask).fresh, *rounds):
        columns = stacked(exchanges)
        each = parts(InTurn(ask.truth.function)(*columns))
        assert gaps(ask.kinds, parts(ask.truth(*columns)), each).max() < 1e-14


def one_thing(number, name, slug, other):
    """Return whether two names are allowed for the same numbers: `alike` of the row."""
    return slug == other or any({slug, other} <= names for names in ALIKE[number, name])


def as_answers(S):
    return S[0] if len(S) == 1 else S


@every
def test_no_mistake_is_there_that_no_question_shows(number, name, ask):
    shown = {mistake.slug for mistake, _ in redone(ask)}
    assert {mistake.slug for mistake in ask.named} == shown


@every
def test_no_two_mistakes_look_alike_on_the_questions_asked(number, name, ask):
    found = redone(ask)
    for i, (a, S_a) in enumerate(found):
        for b, S_b in found[:i]:
            if alike(S_a, S_b):
                assert one_thing(number, name, a.slug, b.slug), (a.slug, b.slug)


@every
def test_numbers_at_random_get_no_name(number, name, ask):
    rng = np.random.default_rng(5)
    S = tuple(
        kind.scale * rng.normal(size=part.shape)
        for kind, part in zip(ask.kinds, right(ask), strict=True)
    )
    verdict = judged(ask, as_answers(S))
    assert verdict.status == "wrong"
    assert verdict.mistake not in {mistake.slug for mistake in ask.named}
    whole = any(kind.whole for kind in ask.kinds)
    assert whole or any(character.isdigit() for character in verdict.message)


@every
@settings(max_examples=10, deadline=None)
@given(seed=st.integers(0, 2**32 - 1), exponent=st.floats(-16, -9))
def test_a_right_answer_with_rounding_noise_passes(number, name, ask, seed, exponent):
    rng = np.random.default_rng(seed)
    S = tuple(
        part + noise(kind) * 10.0**exponent * rng.uniform(-1, 1, part.shape)
        for kind, part in zip(ask.kinds, right(ask), strict=True)
    )
    assert judged(ask, as_answers(S)).status == "passed"


def noise(kind):
    """Return what an entry may be off in: a count or a choice is what it is."""
    return 0.0 if kind.whole else kind.scale


@every
def test_a_nearly_right_answer_is_close_and_never_a_mistake(number, name, ask):
    if ask.rtol or all(kind.whole for kind in ask.kinds):
        return  # there nothing is nearly right
    rng = np.random.default_rng(8)
    S = tuple(
        part + noise(kind) * 0.3 * ask.near * rng.uniform(0.5, 1, part.shape)
        for kind, part in zip(ask.kinds, right(ask), strict=True)
    )
    verdict = judged(ask, as_answers(S))
    assert (verdict.status, verdict.mistake) == ("close", "rounded-somewhere")


@every
def test_questions_are_the_same_every_time_and_all_of_a_kind(number, name, ask):
    first, again = round_of(ask), round_of(ask)
    for one, same in zip(first.exchanges, again.exchanges, strict=True):
        for arg, equal in zip(one.question.args, same.question.args, strict=True):
            np.testing.assert_equal(arg, equal)
    for some in zip(*(one.question.args for one in first.main), strict=True):
        numbers = [arg for arg in some if np.asarray(arg).dtype != object]  # no worlds
        assert len({np.ndim(arg) for arg in numbers}) <= 1


@every
def test_an_edge_value_has_one_right_answer(number, name, ask):
    for call in ask.edges:
        columns = stacked([Exchange(Question("", name, call))] * 2)
        first = parts(ask.truth(*columns))
        for off in (1e-12, -1e-12):
            near = [moved(column, off) for column in columns]
            with contextlib.suppress(Robo47Error):  # there it has no answer at all
                apart = gaps(ask.kinds, parts(ask.truth(*near)), first, ask.rtol)
                assert apart.max() <= ask.near, (
                    f"{typed(Question('', name, call))} is an edge: with 1e-12 more or "
                    "less there, another answer is right. Say in the Row which calls "
                    "with edge values have one: at_edge=lambda ...: ..."
                )


@every
def test_an_answer_that_never_changes_is_not_right(number, name, ask):
    for part in right(ask):
        assert len(part) > 1, "one question alone: ask several"
        assert difference(part[1:], np.broadcast_to(part[:1], part[1:].shape)).any()


@pytest.mark.parametrize(
    ("number", "name", "ask"), [row for row in ROWS if row.values[2].accept]
)
def test_accept_takes_the_labs_own_answer_and_no_numbers_at_random(number, name, ask):
    function, rng = (
        getattr(lab_of(find_day(number)), name),
        np.random.default_rng(5),
    )
    for exchange in round_of(ask).main:
        answer = function(*exchange.question.args)
        noise = tuple(
            kind.scale * rng.normal(size=np.shape(part))
            for kind, part in zip(ask.kinds, parts(answer), strict=True)
        )
        assert ask.accept(*exchange.question.args, answer) is None
        assert ask.accept(*exchange.question.args, as_answers(noise)) is not None
