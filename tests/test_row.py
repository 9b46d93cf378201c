"""Rows: mistakes of one function that stand together."""

import pytest

from labkit.judge import Scalar
from labkit.judge.row import REDONE, Row


def row_of_two(answers):
    """Return a row with two mistakes, whose answers a function of x gives."""
    row = Row(Scalar())

    @row.wrongs
    def _(x):
        """doubled: it is there
          twice => 2 x
        negative: its sign is wrong
        """
        return answers(x)

    return row


def test_each_mistake_of_a_function_is_a_way_with_its_sentence_and_its_answer():
    row = row_of_two(lambda x: {"doubled": 2 * x, "negative": lambda: -x})
    doubled, negative = row.named
    assert (doubled.slug, doubled.says) == ("doubled", "it is there twice")
    assert (doubled.redone, negative.redone) == ("2 x", REDONE)
    assert (doubled.code(3), negative.code(3)) == (6, -3)


def test_one_that_stops_leaves_the_others_alone():
    row = row_of_two(lambda x: {"doubled": lambda: 1 / 0, "negative": -x})
    assert row.named[1].code(3) == -3


def test_an_answer_without_a_sentence_is_found_and_a_sentence_without_an_answer():
    for answers in ({"doubled": 6}, {"doubled": 6, "negative": -3, "halved": 1.5}):
        with pytest.raises(KeyError, match=r"negative|halved"):
            row_of_two(lambda x, answers=answers: answers).named[0].code(3)
