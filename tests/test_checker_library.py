"""What student code may import: the library of earlier days, and nothing later."""

import pytest

from robo47.checker import library
from robo47.errors import Robo47Error
from robo47.lesson.day import all_days, find_day


def test_the_first_day_may_import_no_answer():
    assert set(library.library_of(find_day(1))) == {"kit"}


def test_each_day_gets_all_earlier_days_and_what_they_import_themselves():
    days = all_days()
    for day in days:
        names = set(library.library_of(day))
        for other in days:
            for name in other.library:
                assert (f"robo47.{name}" in names) == (other.number < day.number)


def test_what_travels_needs_no_simulator():
    for day in all_days():
        for name, source in library.library_of(day).items():
            assert "import mujoco" not in source, name


def test_a_library_that_leads_to_a_later_answer_is_refused(monkeypatch):
    import dataclasses

    first = find_day(1)
    early = dataclasses.replace(first, number=1, library=("jacobian",))
    late = dataclasses.replace(first, number=2, library=("screws",))
    monkeypatch.setattr(library, "all_days", lambda: [early, late])
    with pytest.raises(
        Robo47Error, match=r"screws\.py is an answer of a day from 2 on"
    ):
        library.library_of(late)


def test_a_module_that_is_not_there_is_named(monkeypatch):
    import dataclasses

    early = dataclasses.replace(find_day(1), number=1, library=("nonesuch",))
    monkeypatch.setattr(library, "all_days", lambda: [early])
    with pytest.raises(Robo47Error, match=r"robo47/nonesuch\.py, which is not there"):
        library.library_of(dataclasses.replace(early, number=2))
