"""A week's manifest: what is wrong with one is named; the course is `weeks()`."""

from dataclasses import dataclass, replace
from types import SimpleNamespace

import pytest

from conftest import write_week
from labkit.check import own_functions
from labkit.lesson.day import chosen_week, day_numbers, find_day
from labkit.lesson.week import entry, fill, find_week, weeks
from robo47.errors import Robo47Error


def made(root, name, *days):
    """Write a week whose days are empty manifests."""
    for number in days:
        (root / name / f"day{number}").mkdir(parents=True)
        (root / name / f"day{number}" / "day.toml").write_text("")
    (root / name).mkdir(exist_ok=True)
    write_week(root / name, *days)
    return root / name / "week.toml"


@pytest.fixture
def course(tmp_path):
    made(tmp_path, "w2-b", 4, 5)
    made(tmp_path, "w1-a", 1, 2, 3)
    return tmp_path


def test_weeks_and_days_come_in_order_whatever_the_folders_are_called(course):
    made(course, "w10-j", 60)
    (course / "work").mkdir()
    (course / "wheels").mkdir()
    headings = [week.heading for week in weeks(course)]
    assert headings == ["Week 1: a", "Week 2: b", "Week 10: j"]
    assert day_numbers(course) == [1, 2, 3, 4, 5, 60]


@pytest.mark.parametrize("name", ["w2_perception", "w3-x", "perception"])
def test_a_folder_that_looks_like_a_week_and_is_none_is_refused_by_name(course, name):
    (course / name / "day8").mkdir(parents=True)
    (course / name / "day8" / "day.toml").write_text("")
    with pytest.raises(Robo47Error, match=f"{name}/ has no week.toml"):
        weeks(course)


@pytest.mark.parametrize(
    ("old", "new", "says"),
    [
        ("number = 2", "number = 3", "its folder is w3-b, not w2-b"),
        ("number = 2", "number = 'two'", "number is 'two'; expected a whole number"),
        ("number = 2", "", "number is None"),
        ('name = "b"', 'name = "c"', "its folder is w2-c, not w2-b"),
        ("days = [4, 5]", "days = [5, 4]", "days are [5, 4]; expected each once"),
        ("days = [4, 5]", "days = [4]", "day5/ is there, and is not in days"),
        ("days = [4, 5]", "days = [4, 5, 6]", "day6/day.toml is not there"),
        ("days = [4, 5]", 'days = ["4"]', "days holds '4', not a whole number"),
        ("days", "titel = 'x'\ndays", "no entry is called titel"),
        ("days", "soon = [{number = 5, title = 'x'}]\ndays", "day 5 is in days"),
        ("number", "numb[er", "cannot be read"),
    ],
)
def test_what_is_wrong_in_a_weeks_manifest_is_named(course, old, new, says):
    path = course / "w2-b" / "week.toml"
    path.write_text(path.read_text().replace(old, new))
    with pytest.raises(Robo47Error, match=r"w2-b/week\.toml") as caught:
        weeks(course)
    assert says in str(caught.value)


def test_an_entry_that_has_to_be_there_is_missed_where_its_whole_table_is():
    @dataclass
    class Rules:
        most: int = entry(at="limits.most")

    assert fill(Rules, {"limits": {"most": 3}}).most == 3
    with pytest.raises(Robo47Error, match="most is None; expected a whole number"):
        fill(Rules, {})


def test_two_weeks_of_one_number_are_refused(course):
    made(course, "w2-c", 6)
    with pytest.raises(Robo47Error, match=r"two weeks 2: .*w2-b, .*w2-c"):
        weeks(course)


def test_a_week_that_does_not_exist_is_told_with_those_that_do(course):
    with pytest.raises(Robo47Error, match="no week 99 yet; the kit has: 1, 2"):
        find_week(99, course)
    assert find_week(2, course).days == (4, 5)


def test_a_command_means_the_week_that_is_named_or_that_of_the_day():
    assert chosen_week(1).number == chosen_week(None, 2).number == 1
    with pytest.raises(Robo47Error, match="no week 99"):
        chosen_week(99)
    with pytest.raises(Robo47Error, match="no day 99"):
        chosen_week(None, 99)


def test_another_days_function_never_replaces_that_of_the_capstones_own_day(
    monkeypatch,
):
    first = find_day(1)
    task = next(task for task in first.tasks if "inverse" in task.functions)
    other = replace(find_day(2), tasks=(task,))  # it has an `inverse` of its own

    def own(day):
        return SimpleNamespace(inverse=lambda: day.number)

    passed = {task.id: "passed" for task in first.tasks}
    monkeypatch.setattr(own_functions, "days_of", lambda week: [first, other])
    monkeypatch.setattr(own_functions, "statuses", lambda day: passed)
    monkeypatch.setattr(own_functions, "_module", own)
    mine = own_functions.load(find_week(1))
    assert mine.functions.inverse() == 1
    assert mine.yours.count("inverse") == 1


def test_a_week_without_a_capstone_says_which_has_one(course):
    with pytest.raises(Robo47Error, match=r"week 2 has no capstone yet; .* one: 1"):
        own_functions.load(find_week(2, course))
