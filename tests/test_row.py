"""Rows: mistakes of one function that stand together."""

import numpy as np
import pytest

from labkit.base.exchange import Exchange, Question
from labkit.judge import Ask, Draw, HeldOut, Scalar
from labkit.judge import argument_mistakes as kinds
from labkit.judge.answers import Several
from labkit.judge.ask import stacked
from labkit.judge.row import Row, inside
from labkit.lesson.day import find_day
from robo47.errors import Robo47Error


def row_of_two(answers):
    """Return a row with two mistakes, whose answers a function of x gives."""
    row = Row(Scalar())

    @row.wrongs
    def _(x):
        """doubled: it is there
          twice => both
        negative: its sign is wrong
        """
        return answers(x)

    return row


def test_each_mistake_of_a_function_is_a_way_with_its_sentence():
    row = row_of_two(lambda x: {"doubled": 2 * x, "negative": lambda: -x})
    doubled, negative = row.named
    assert (doubled.slug, doubled.says) == ("doubled", "it is there twice")
    assert (doubled.both, negative.both) == (True, False)
    assert (doubled.code(3), negative.code(3)) == (6, -3)


def test_one_that_stops_leaves_the_others_alone():
    row = row_of_two(lambda x: {"doubled": lambda: 1 / 0, "negative": -x})
    assert row.named[1].code(3) == -3


def test_an_answer_without_a_sentence_is_found_and_a_sentence_without_an_answer():
    for answers in ({"doubled": 6}, {"doubled": 6, "negative": -3, "halved": 1.5}):
        with pytest.raises(KeyError, match=r"negative|halved"):
            row_of_two(lambda x, answers=answers: answers).named[0].code(3)


def test_a_table_says_what_the_lab_cannot_show():
    row = Row(Scalar())

    @row.wrongs(hidden={"negative": "x is positive there"})
    def _(x):
        """doubled: it is there twice
        negative: its sign is wrong
        """
        return {"doubled": 2 * x, "negative": -x}

    doubled, negative = row.named
    assert (doubled.hidden, negative.hidden) == ("", "x is positive there")


def test_a_table_is_made_once_per_question_and_nobody_spoils_it_for_the_others():
    asked = []

    def answers(x):
        asked.append(x.tolist())
        return {"doubled": 2 * x, "negative": -x}

    doubled, negative = row_of_two(answers).named
    for x in (np.ones(2), np.zeros(2), np.ones(2)):
        doubled.code(x)[:] = 5.0
        assert negative.code(x).tolist() == (-x).tolist()
        assert doubled.code(x).tolist() == (2 * x).tolist()
    assert asked == [[1.0, 1.0], [0.0, 0.0]]


@pytest.mark.parametrize(
    ("change", "used"),
    [
        (kinds.RADIANS_TWICE, np.deg2rad([1.0, 2, 3, 4, 5, 6])),
        (kinds.DEGREES, np.rad2deg([1.0, 2, 3, 4, 5, 6])),
        (kinds.HALVES_SWAPPED, [4, 5, 6, 1, 2, 3]),
        (kinds.FIRST_FOR_ALL, [1, 1, 1, 1, 1, 1]),
        (kinds.OF_ALL_JOINTS[4], [1, 2, 3, 4, 5, 0]),
    ],
    ids=lambda x: getattr(x, "slug", ""),
)
def test_a_mistake_of_an_argument_is_made_before_it_is_used(change, used):
    assert np.allclose(change.redo(np.arange(1.0, 7.0)), used)


def test_what_is_found_by_a_held_out_question_cannot_pass():
    with pytest.raises(Robo47Error, match="status is 'passed'; expected"):
        HeldOut("remark", "A remark.", lambda rng: [(9.0,)], status="passed")


def test_one_mistake_can_be_made_in_two_ways():
    row = Row(Scalar())

    @row.wrongs
    def _(x):
        """doubled: it is there twice
        doubled 2: it is added once more
        """
        return {"doubled": 2 * x, "doubled 2": x + x}

    assert [way.slug for way in row.named] == ["doubled", "doubled"]
    assert [way.code(3) for way in row.named] == [6, 6]


def test_a_row_of_many_right_answers_refuses_a_question_that_asks_for_one():
    def ask(**more):
        held = HeldOut("x", "It says x.", lambda rng: [(5.0,)], **more)
        return Ask(
            lambda rng: [(1.0,)],
            Scalar(),
            accept=lambda x, y: None,
            held_out=[held],
        )

    with pytest.raises(Robo47Error, match='"x" asks for the right answer'):
        ask()
    assert ask(mistaken=lambda x: 2 * x).held_out[0].slug == "x"


def test_inputs_that_stop_are_told_with_the_line_of_the_file_that_leads_there():
    row = Row(Scalar(), truth=lambda x: x)
    row.inputs(lambda rng: [(rng.uniform(0.0, "a"),)])
    row.bind(find_day(1), "Rz")
    with pytest.raises(Robo47Error) as told:
        row.ask.main  # noqa: B018
    says = str(told.value)
    assert says.startswith("w1-foundations/day1/Rz.py: its inputs function stops with ")
    assert "(tests/test_row.py, line " in says


def test_a_shape_of_drawn_numbers_may_be_one_tuple():
    one, other = (Draw(1).numbers(0.0, 1.0, *shape) for shape in ((2, 3), ((2, 3),)))
    assert (one == other).all()


@pytest.mark.parametrize(
    ("where", "says", "told"),
    [
        ("in the adjoint, ", "in [p], a sign is lost", "in [p] of the adjoint, a sign"),
        (
            "in every factor, ",
            "in [p] of the adjoint, x",
            "in [p] of the adjoint in every",
        ),
        ("in `outer`, ", "in `inner`, x is lost", "in `inner`, x is lost"),
        ("in the adjoint, ", "a sign is lost", "in the adjoint, a sign is lost"),
        ("in each link's matrix ", "c is not used", "in each link's matrix c is not"),
    ],
)
def test_the_place_of_a_mistake_is_one_phrase(where, says, told):
    assert inside(where, says).startswith(told)


def test_a_tuple_of_arrays_is_one_argument_and_no_mistake_changes_it():
    row = Row(Scalar(), truth=lambda pair: float(pair[0].sum() + len(pair[1])))
    row.function = "summed"
    first, second = np.array([1.0, 2.0]), np.zeros((3, 1))

    @row.inputs
    def _(rng):
        yield ((first, second),)
        yield ((rng.numbers(0, 1, 4), second),)

    @row.wrongs
    def _(pair):
        """emptied: it is set to 0 first"""
        pair[0][:] = 0.0
        return {"emptied": 1.0 * len(pair[1])}

    asked = row.ask.main
    assert [isinstance(call[0], Several) for call in asked] == [True, True]
    assert row.ask.drawn == 1  # the first is the same for each seed
    columns = stacked([Exchange(Question("", "", call)) for call in asked])
    assert row.ask.truth(*columns)[0] == 6.0
    assert row.ask.mistakes()[0].redo(*columns).tolist() == [3.0, 3.0]
    assert first.tolist() == [1.0, 2.0]
    assert (np.shape(asked[0][0]), np.size(asked[0][0])) == ((), 5)
    assert np.asarray(asked[0][0]).dtype == object
