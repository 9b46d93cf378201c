"""`make author` names the arguments that a lab uses and no question reaches."""

import pytest

from conftest import days
from labkit.author import ranges
from labkit.judge.row import Row, rows_of
from labkit.lesson.day import find_day

pytestmark = pytest.mark.kit
# Some arguments cannot be scaled: a unit axis, or a bound that would leave no range.
LEFT = 5  # arguments of a day, at most


def test_the_questions_reach_what_the_lab_uses():
    assert not list(ranges.faults_of(find_day(1)))


def test_an_argument_that_no_question_reaches_is_named(monkeypatch):
    day = find_day(1)
    rows = rows_of(day)
    old = rows["make_T"]
    bare = Row(old.more["kind"]).bind(day, "make_T")
    bare.inputs(old.more["inputs"])
    monkeypatch.setattr(ranges, "rows_of", lambda day: {"make_T": bare})
    (fault,) = ranges.faults_of(day)
    assert fault.startswith("make_T: t is 0.08")
    assert fault.endswith("no question has a value below 1: name one in row.spans")


@pytest.mark.soak
@pytest.mark.parametrize("day", days(), ids=lambda day: f"day{day.number}")
def test_the_questions_of_every_day_reach_nearly_all(day):
    assert len(list(ranges.faults_of(day))) <= LEFT
