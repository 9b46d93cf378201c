"""A day's manifest: what is wrong in one is named; days and tasks are found."""

import re

import pytest

from conftest import write_week
from labkit.lesson.day import (
    Metric,
    all_days,
    day_numbers,
    find_day,
    find_task,
    load_day,
    started_day,
)
from robo47.errors import Robo47Error

DAY = find_day(1)
TEXT = (DAY.own / "day.toml").read_text("utf-8")
HINT = re.search(r'"""Draw the 4x4.*?"""', TEXT, re.DOTALL).group()


def edited(tmp_path, *changes):
    text = TEXT
    for old, new in changes:
        assert old in text
        text = text.replace(old, new, 1)
    return written(tmp_path / "w1-x", 1, text)


def written(week, number, text):
    """Add a day's manifest to a week."""
    path = week / f"day{number}" / "day.toml"
    path.parent.mkdir(parents=True)
    path.write_text(text, "utf-8")
    write_week(week, *range(1, number + 1))
    return path


@pytest.mark.parametrize(
    ("change", "says"),
    [
        ((HINT, '" "'), r"tasks 1\.1: hints holds ' '"),
        (('title = "A rotation about z"', 'title = ""'), r"tasks 1\.2: title is ''"),
        (
            ('functions = ["Rz"]', "functions = []"),
            r"1\.2: functions has too few entries \(0\)",
        ),
        (('id = "1.2"', 'id = "1.1"'), r"two tasks have the id 1\.1"),
        (('id = "1.2"', 'id = "2.2"'), r"id 2\.2 is not one of day 1"),
        (('functions = ["Rz"]', 'functions = ["make_T"]'), "another task has make_T"),
        (('needs = ["1.6"]', 'needs = ["1.9"]'), r"1\.8 needs 1\.9"),
        (("max = 1e-10", 'max = "small"'), "max is 'small'; expected a number"),
        (("max = 1e-10", ""), "metrics 1: it has neither max nor min"),
        (("minutes = 180", "minutes = true"), "minutes is True; expected a whole"),
        (("[figure]", "[picture]"), "no entry is called picture; there are"),
        (("drawings = 3", "drawing = 3"), "worksheet: no entry is called drawing"),
        (('id = "1.4"', "id = 1.4"), "expected a text"),
        (("[[metrics]]", "[[metrics"), "cannot be read"),
        (('read = "Lab', 'seconds = 61\nread = "Lab'), "a grader gives 60 at"),
        (("number = 1", "number = 2"), "number is 2, but the folder is day1"),
        (('read = "Lab', 'without = ["x"]\nread = "Lab'), "no entry is called without"),
    ],
)
def test_what_is_wrong_in_a_manifest_is_named(tmp_path, change, says):
    with pytest.raises(Robo47Error, match=says):
        load_day(edited(tmp_path, change))


def test_figure_worksheet_and_metrics_are_optional(tmp_path):
    start, end = TEXT.index("[figure]"), TEXT.index("[[tasks]]")
    day = load_day(edited(tmp_path, (TEXT[start:end], "")))
    assert (day.figure, day.worksheet, day.metrics, day.terms) == ("", "", (), ())


def test_a_broken_manifest_costs_its_own_day_alone(tmp_path):
    edited(tmp_path)
    written(tmp_path / "w1-x", 2, "number = ")
    assert find_day(1, tmp_path).title == DAY.title
    with pytest.raises(Robo47Error, match=r"day2/day\.toml cannot be read"):
        find_day(2, tmp_path)


def test_two_weeks_may_not_have_the_same_day(tmp_path):
    edited(tmp_path)
    written(tmp_path / "w2-y", 1, TEXT)
    with pytest.raises(Robo47Error, match="two days 1"):
        find_day(1, tmp_path)


def test_the_day_begun_last_is_the_default(tmp_path):
    edited(tmp_path)
    assert started_day(tmp_path) == 1
    written(tmp_path / "w1-x", 2, "")
    assert day_numbers(tmp_path) == [1, 2]
    assert started_day(tmp_path) == 1
    work = tmp_path / "w1-x" / "work"
    work.mkdir()
    (work / "day2_helpers.py").write_text("")
    assert started_day(tmp_path) == 2


def test_needs_are_followed_however_indirect():
    assert DAY.needs("1.8") == ("1.1", "1.2", "1.4", "1.5", "1.6")
    assert DAY.needs("1.1") == ()


@pytest.mark.parametrize(
    ("metric", "value", "passes"),
    [
        (Metric("c", "m", max=1.0), 0.5, True),
        (Metric("c", "m", max=1.0), 1.0, False),
        (Metric("c", "m", min=0.95), 0.96, True),
        (Metric("c", "m", min=0.95), 0.95, False),
        (Metric("c", "m", max=1.0), float("nan"), False),
        (Metric("c", "m", min=1.0), float("nan"), False),
        (Metric("c", "m", max=2.0, min=1.0), 3.0, False),
    ],
)
def test_a_metric_has_a_max_or_a_min_and_nan_passes_neither(metric, value, passes):
    assert metric.passes(value) is passes


@pytest.mark.parametrize(
    ("value", "failures", "verdict"),
    [
        (1e-15, 0, "pass"),
        (1e-15, None, "pass"),
        (1e-15, 7, "fail"),  # the largest is fine, some trials were not
        (1e-3, 0, "fail"),
        (-1e-15, 0, "fail"),
        (float("nan"), 0, "fail"),
        ("", 0, "fail"),
    ],
)
def test_a_row_is_judged_in_one_place(value, failures, verdict):
    row = {"value": value, "n_failures": failures, "n_trials": 10}
    assert Metric("c", "m", max=1e-8).judge(row) == verdict
    assert Metric("c", "m", max=1e-8).judge(None) == "none"


def test_a_day_or_task_that_does_not_exist_is_told_with_those_that_do():
    numbers = ", ".join(str(day.number) for day in all_days())
    with pytest.raises(Robo47Error, match=f"no day 48 yet; the kit has: {numbers}"):
        find_day(48)
    with pytest.raises(Robo47Error, match=r"no task 1\.9; it has 1\.1, 1\.2"):
        find_task("1.9")
    with pytest.raises(Robo47Error, match="'fk' is no task"):
        find_task("fk")
    assert find_task("1.4")[1].functions == ("quat_to_R",)
