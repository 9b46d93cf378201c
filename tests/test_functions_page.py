"""The page of the library's functions: what a student may use, and is not to guess."""

import re

import pytest

from conftest import ROOT
from labkit.base.text import blocks
from labkit.commands import docs
from labkit.lesson.day import all_days
from labkit.lesson.functions import functions_list
from labkit.sandbox.messages import library_of

PAGE = docs.FUNCTIONS.read_text("utf-8")
LINE = re.compile(r"- `(\w+)\.(\w+)\((.*)\)`: \S.*[^.]")


def test_the_page_is_what_the_docstrings_say_today():
    assert docs.rebuilt(PAGE, docs.FUNCTIONS.parent)[1] == []
    other = PAGE.replace("log_rotation(R)", "log_rotation(R, t)")
    assert docs.rebuilt(other, docs.FUNCTIONS.parent) == (PAGE, ["by day"])


def test_what_nobody_could_guess_stands_there():
    assert "`jacobian.log_rotation(R)`: " in PAGE
    assert "`screws.exp_rotation(axis, theta)`: " in PAGE  # two arguments


def test_every_line_is_a_function_that_can_be_called_so():
    lines = [line for block in blocks(PAGE, "functions") for line in block.splitlines()]
    listed = [line for line in lines if line and line[0] != "#"]
    assert len(listed) > 60
    for line in listed:
        assert LINE.fullmatch(line), line
    names = [LINE.fullmatch(line).group(1, 2) for line in listed]
    assert len(names) == len(set(names))


@pytest.mark.parametrize("day", all_days(), ids=lambda day: str(day.number))
def test_what_a_later_day_may_use_its_check_lets_in(day):
    """Each module under the days before this one; none of this day's own."""
    parts = re.split(r"^### Day (\d+): .*$", functions_list("by day"), flags=re.M)
    modules = {
        int(number): {LINE.fullmatch(line)[1] for line in text.strip().splitlines()}
        for number, text in zip(parts[1::2], parts[2::2], strict=True)
    }
    let_in = library_of(day)
    for number, names in modules.items():
        inside = {name for name in names if f"robo47.{name}" in let_in}
        assert inside == (names if number < day.number else set()), number


@pytest.mark.parametrize("day", all_days()[1:], ids=lambda day: str(day.number))
def test_each_guide_leads_to_it(day):
    guide = day.folder / day.guide
    (link,) = re.findall(r"\]\((\S*library\.md)\)", guide.read_text("utf-8"))
    assert (guide.parent / link).resolve() == ROOT / "docs" / "library.md"
