"""What student code may import: the library of earlier days, and nothing later."""

import dataclasses

import pytest

from labkit.lesson.day import all_days, find_day
from labkit.sandbox import messages
from robo47.errors import Robo47Error


def test_the_first_day_may_import_no_answer():
    assert set(messages.library_of(find_day(1))) == {"kit"}


def test_each_day_gets_all_earlier_days_and_what_they_import_themselves():
    days = all_days()
    for day in days:
        names = set(messages.library_of(day))
        for other in days:
            for name in other.library:
                assert (f"robo47.{name}" in names) == (other.number < day.number)


def test_what_travels_needs_no_simulator():
    for day in all_days():
        for name, source in messages.library_of(day).items():
            assert "import mujoco" not in source, name


def days_of(monkeypatch, *days):
    def earlier(day):
        return [one for one in days if one.number < day.number]

    monkeypatch.setattr(messages, "days_before", earlier)


def test_a_library_that_leads_to_this_days_answer_is_refused(monkeypatch):
    early = dataclasses.replace(find_day(1), number=1, library=("jacobian",))
    late = dataclasses.replace(early, number=2, library=("screws",))
    days_of(monkeypatch, early, late)
    with pytest.raises(Robo47Error, match=r"screws\.py is an answer of day 2"):
        messages.library_of(late)


def test_a_module_that_is_not_there_is_named(monkeypatch):
    early = dataclasses.replace(find_day(1), number=1, library=("nonesuch",))
    late = dataclasses.replace(early, number=2, library=())
    days_of(monkeypatch, early, late)
    with pytest.raises(Robo47Error, match=r"robo47/nonesuch\.py, which is not there"):
        messages.library_of(late)
