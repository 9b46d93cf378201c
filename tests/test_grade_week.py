"""Grading several days: one table for a learning platform, one page, a folder a day."""

import csv
import html
import io
import re
import shutil
from pathlib import Path

import pytest
from test_report import MEASURE
from test_week import titles

from conftest import ROOT, copy_kit, keep_first_day, run_copy
from labkit.commands import grade as command
from labkit.grade import page
from labkit.grade.course import Course, GradedStudent
from labkit.grade.result import ungraded
from labkit.grade.roster import Student
from labkit.lesson.day import all_days
from robo47.errors import Robo47Error

pytestmark = pytest.mark.kit
SCRIPT = "scripts/grade_class.py"
TOY = ROOT / "tests" / "toyday" / "w9-toy"
STUDENTS = {"ada": (1, 46), "bob": (1,), "eve": ()}  # and the days they have solved
SCRIPTS = {1: "w1-foundations/{}/day1_transforms.py", 46: "w9-toy/{}/day46_toy.py"}


@pytest.fixture(scope="module")
def kit(tmp_path_factory):
    """Return a copy of the kit with day 1 and the toy day in it, and no other."""
    copy = keep_first_day(copy_kit(tmp_path_factory.mktemp("kit") / "clone"))
    shutil.copytree(TOY, copy / "w9-toy")
    return copy


@pytest.fixture(scope="module")
def run(kit):
    def run_script(*arguments):
        return run_copy(kit, SCRIPT, *arguments, "--i-know-them")

    return run_script


@pytest.fixture(scope="module")
def graded(kit, run, tmp_path_factory):
    """Grade a class of three for both days; return the process and its folder."""
    folder = tmp_path_factory.mktemp("class")
    for name, days in STUDENTS.items():
        (folder / "clones" / name).mkdir(parents=True)
        for day in days:
            work = folder / "clones" / name / SCRIPTS[day].format("work")
            work.parent.mkdir(parents=True)
            shutil.copyfile(kit / SCRIPTS[day].format("src"), work)
    roster = "name,folder,email\n=Ada,ada,ada@example.org\nBob,bob,\nEve,eve,\n"
    roster += "No,nobody,\n"
    (folder / "clones" / "roster.csv").write_text(roster, "utf-8")
    out = folder / "out" / "grades.csv"
    done = run(folder / "clones", "--day", "1-46", "--out", out)
    assert done.returncode == 0, done.stdout + done.stderr
    return done, folder


def rows(file):
    text = file.read_bytes().decode("utf-8-sig")
    return {row["folder"]: row for row in csv.DictReader(io.StringIO(text))}


def test_one_table_holds_everybody_and_every_day(graded):
    found = rows(graded[1] / "out" / "grades.csv")
    ada, bob, eve, nobody = (found[name] for name in ("ada", "bob", "eve", "nobody"))
    assert (ada["id"], ada["name"]) == ("ada@example.org", "'=Ada")
    assert [ada[f"day{n}_percent"] for n in (1, 46)] == ["100.0", "100.0"]
    assert [bob[f"day{n}_percent"] for n in (1, 46)] == ["100.0", "0.0"]
    assert ada["percent"] == "100.0"
    assert ada["kit"]
    assert ada["day1_late_days"] == ""  # no deadline
    assert ada["seed"].isdecimal()
    assert bob["percent"] == "53.3"  # 8 of 15: the toy day's side quest counts nowhere
    assert eve["percent"] == "0.0"
    assert (nobody["percent"], nobody["day1_percent"]) == ("", "")
    assert "day 46: there is no such folder" in nobody["error"]


def test_each_day_has_a_folder_as_if_it_were_graded_alone(graded, run, tmp_path):
    _, folder = graded
    for day in SCRIPTS:
        own = folder / "out" / f"day{day}"
        names = {path.name for path in own.iterdir()}
        assert names == {"grades.csv", "class.html", "feedback", "grading.jsonl"}
        text = (own / "feedback" / "ada.txt").read_text("utf-8")
        assert f"Day {day}" in text
    alone = tmp_path / "grades.csv"
    seed = re.search(r"--seed \d+", graded[0].stdout)[0].split()
    arguments = ("--day", "46", "--out", alone, *seed)
    assert run(folder / "clones", *arguments).returncode == 0
    week = folder / "out" / "day46" / "grades.csv"
    assert alone.read_bytes() == week.read_bytes()


def test_the_page_leads_to_the_days_and_stays_harmless(graded):
    page = (graded[1] / "out" / "class.html").read_text("utf-8")
    assert '<a href="day46/class.html">' in page
    assert "Days 1 to 46" in page
    assert "2 of 4 done" in page
    assert "<script" not in page


def test_it_is_told_in_a_line_a_day(graded):
    lines = graded[0].stdout.splitlines()
    kit = next(i for i, line in enumerate(lines) if line.startswith("kit: "))
    assert lines[kit + 1].startswith("Day 1, 4 students: 2 done")
    assert lines[kit + 2].startswith("Day 46, 4 students: 1 done")
    assert lines[kit + 3] == "graded now: 8; unchanged since: 0"
    assert max(map(len, lines[: kit + 4])) <= 80


def test_the_same_command_grades_nothing_twice(graded, run):
    _, folder = graded
    out = folder / "out" / "grades.csv"
    before = out.read_bytes()
    done = run(folder / "clones", "--day", "all", "--out", out)
    assert "graded now: 0; unchanged since: 8" in done.stdout
    assert out.read_bytes() == before


@pytest.mark.parametrize(
    ("day", "says"),
    [
        ("monday", r"--day monday: expected a day \(2\), days \(1-7\), or all"),
        ("7-3", "the kit has none of the days 7 to 3"),
        ("98-99", "the kit has none of the days 98 to 99"),
        ("99", "there is no day 99 yet; the kit has: 1, 2"),
    ],
)
def test_days_that_are_none_are_refused_in_a_line(day, says):
    with pytest.raises(Robo47Error, match=says):
        command.chosen(day)


# The number of pairs of words in a card of which one covers a part of the other.
OVERLAPS = """(() => {{
  const all = [...d.querySelectorAll('.card span, .card text')]
    .filter(e => !e.querySelector('*')).map(e => e.getBoundingClientRect());
  return all.filter((a, i) => all.slice(i + 1).some(b =>
    a.left < b.right - 1 && b.left < a.right - 1 &&
    a.top < b.bottom - 1 && b.top < a.bottom - 1)).length; }})()"""


@pytest.mark.browser
def test_no_words_overlap_on_the_page_of_all_days(tmp_path, chromium):
    one = Student("Ada", "ada", Path())
    courses = [
        Course(day, [GradedStudent(one, ungraded(day, "")) for _ in range(20)])
        for day in all_days()
    ]
    text = html.escape(page.render_days(courses))
    harness = MEASURE.replace("d.documentElement.scrollWidth", OVERLAPS)
    pages = [harness.format(width=width, page=text) for width in (390, 950, 1280)]
    for found in titles(chromium, tmp_path, *pages):
        *_, overlaps, too_wide, _, _, made = found.split()
        assert (overlaps, too_wide, made) == ("0", "0", "0")
