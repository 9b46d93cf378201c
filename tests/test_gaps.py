"""What `make gaps` changes in a function, and what it prints."""

import sys

import pytest

from labkit.author.by_machine import text_of, told_by_machine
from labkit.commands.gaps import changes, unnoticed
from labkit.judge import Row
from labkit.judge.row import rows_of
from labkit.lesson.day import find_day

pytestmark = [
    pytest.mark.kit,
    pytest.mark.skipif(sys.platform == "win32", reason="no SIGALRM there"),
]


def test_a_limit_is_moved_a_constant_doubled_and_a_sign_taken_away():
    source = "def f(x):\n    return 2.0 if abs(x) < 0.5 else x\n"
    found = {change.says for change in changes(source)}
    line = "return 2.0 if abs(x) < 0.5 else x"
    assert f"{line} => return 4.0 if abs(x) < 0.5 else x" in found
    assert f"{line} => return 2.0 if abs(x) >= 0.5 else x" in found
    assert f"{line} => return 2.0 if abs(x) < 10.0 * 0.5 else x" in found
    assert f"{line} => return 2.0 if x < 0.5 else x" in found
    assert "first x = np.abs(x)" in found


def test_an_entry_is_printed_if_the_machine_names_it_when_all_these_are_deleted():
    day = find_day(1)
    row = Row(rows_of(day)["Rz"].ask.kinds[0]).bind(day, "Rz")
    row.inputs(lambda rng: [(x,) for x in (0.3, -2.0, 1.1, rng.uniform(-3, 3))])

    @row.wrong
    def twice(theta):
        "the angle is doubled"
        return row.truth(2 * theta)

    @row.wrong
    def of_another_angle(theta):
        "the angle is replaced by a polynomial"
        return row.truth(theta**5 - 0.7 * theta**3 + 0.1)

    (one,) = told_by_machine(day, row)
    assert (one.slug, one.source, one.shown) == ("twice", "slip", True)
    assert "Your code uses twice `theta`. The wrong expression" in one.machine
    assert "`2 * theta`" in one.machine  # as it stands in the entry's own text


def test_an_entrys_text_is_that_of_a_students_function():
    def entry(theta):
        """Return it."""
        return theta

    assert text_of(entry, "Rz").startswith("def Rz(theta):")


def test_what_no_question_asks_is_found_and_what_is_asked_is_not():
    day = find_day(1)
    row = rows_of(day)["Rz"]
    assert not list(unnoticed(row, "Rz"))
    few = Row(row.ask.kinds[0], truth=row.truth).bind(day, "Rz")
    few.inputs(lambda rng: [(0.0,), (0.5,), (1.0,)])
    assert "first theta = np.abs(theta)" in list(unnoticed(few, "Rz"))
