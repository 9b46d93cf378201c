"""A class's grades as Canvas and Moodle ask for them, read back as they read them."""

import csv
import io
import re

import pytest
from make_class import DAY
from test_grade_in_time import result

from conftest import ROOT
from labkit.grade import page
from labkit.grade.course import Course, GradedStudent
from labkit.grade.result import ungraded
from labkit.grade.roster import find_students
from labkit.grade.sheet import PLATFORMS, as_csv, for_platform, known, of_days
from labkit.lesson.day import find_day
from robo47.errors import Robo47Error

pytestmark = pytest.mark.kit

CANVAS, MOODLE = PLATFORMS["canvas"], PLATFORMS["moodle"]
HOSTILE = '=HYPERLINK("http://x")', "+1", "@a", "a;b", "a\tb", '"', "Ünal, Ay\u202eşe"
HEAD = "Student,ID,SIS User ID,SIS Login ID,Section,Email address,ID number,folder"


def class_of(tmp_path, head=HEAD):
    """Return ten students, seven with names that try something; s9 is not graded."""
    lines, names = io.StringIO(), [*HOSTILE, "Mia", "Tom", "Zoe"]
    table = csv.writer(lines)
    table.writerow(head.split(","))
    for i, name in enumerate(names):
        row = [name, 100 + i, f"u{i}", f"login{i}", "A", f"s{i}@x.org", f"0{i}"]
        table.writerow([*row, f"s{i}"])
    (tmp_path / "roster.csv").write_text(lines.getvalue(), "utf-8-sig")
    students = find_students(tmp_path)
    results = [result(min(i, 8)) for i in range(len(students))]
    days = results, [*results[:-1], ungraded(DAY, "")]
    return [
        Course(find_day(number), list(map(GradedStudent, students, found)))
        for number, found in enumerate(days, 1)
    ]


def read(content):
    return list(csv.reader(io.StringIO(content.decode("utf-8-sig")), strict=True))


def test_canvas_finds_its_header_its_points_and_everybody(tmp_path):
    courses = class_of(tmp_path)
    known(CANVAS, find_students(tmp_path))
    head, points, *rows = read(for_platform(CANVAS, courses, "Lab {day} (471{day})"))
    # What its importer asks of a header: row_has_student_headers?, update_column_count.
    assert "Student" in head[0]
    assert "ID" in head[1]
    assert re.search(r"SIS\s+Login\s+ID", head[2])
    assert "Section" in head[3]
    assert head[4:] == ["Lab 1 (4711)", "Lab 2 (4712)"]  # the title and Canvas' own id
    assert "Points Possible" in points[0]
    assert points[4:] == ["100", "100"]
    assert [row[1:4] for row in rows] == [
        [str(100 + i), f"login{i}", "A"] for i in range(9)
    ]
    assert [row[4] for row in rows] == [f"{12.5 * min(i, 8):.1f}" for i in range(9)]


def test_moodle_finds_everybody_by_number_or_email(tmp_path):
    head, *rows = read(for_platform(MOODLE, class_of(tmp_path), "Day {day}"))
    assert head == ["ID number", "Email address", "Day 1", "Day 2"]
    assert [row[:2] for row in rows] == [[f"0{i}", f"s{i}@x.org"] for i in range(9)]


ODD = ["x\u2028y", "x\x0by\x85z", "two\nlines", "x\ry", "a\0b", "\u202egnp.exe", '"'
       "<script>alert(1)</script>", "\uff1dSUM(A1)", "\t=1+1", "-2+3", "x" * 90_000,
       "\x1b]0;owned\x07", "Mia,101,mia,,mia", "s0", "../../x", "\ufeff=1"]  # fmt: skip


@pytest.mark.parametrize("whose", ["Student", "ID", "Section", "SIS Login ID"])
def test_a_name_that_students_give_themselves_stays_one_cell(tmp_path, whose):
    """A platform's export holds names that students chose."""
    lines = io.StringIO()
    table = csv.writer(lines)
    table.writerow(["Student", "ID", "SIS Login ID", "Section", "folder"])
    for i, odd in enumerate(ODD):
        row = {"Student": f"n{i}", "ID": i, "SIS Login ID": f"l{i}", "Section": "A"}
        table.writerow([*{**row, whose: odd}.values(), f"s{i}"])
    (tmp_path / "roster.csv").write_text(lines.getvalue(), "utf-8", newline="")
    students = find_students(tmp_path)
    assert [one.folder for one in students] == [f"s{i}" for i in range(len(ODD))]
    assert {one.problem for one in students} == {""}
    course = Course(DAY, [GradedStudent(one, result(8)) for one in students])
    tables = [as_csv(course.class_), of_days([course])]
    tables += [for_platform(one, [course], "Day {day}") for one in (CANVAS, MOODLE)]
    for content in tables:
        rows = read(content)
        assert len({len(row) for row in rows}) == 1
        assert not [c for row in rows for c in row if c[:1] in tuple("=+@\uff1d\t\r-")]
        assert all(cell.isprintable() for row in rows for cell in row)
    text = page.render(course) + page.render_days([course])
    assert "<script>alert" not in text
    assert not re.search("[\x00\x1b\u202e\u2028]", text)


@pytest.mark.parametrize("platform", PLATFORMS.values(), ids=PLATFORMS)
def test_no_cell_is_a_formula_or_splits_a_row(tmp_path, platform):
    content = for_platform(platform, class_of(tmp_path), "=1+{day}")
    table = read(content)
    assert {len(row) for row in table} == {len(table[0])}
    cells = [cell for row in table for cell in row]
    assert not [c for c in cells if re.match(r"\s*[=+@|%-]", c) or set(c) & {";", "\t"}]
    assert "\u202e" not in content.decode("utf-8")


def test_who_is_not_graded_has_no_row_that_would_wipe_a_grade_out(tmp_path):
    for platform in PLATFORMS.values():
        table = read(for_platform(platform, class_of(tmp_path), "Day {day}"))
        assert not [row for row in table if "" in row[-2:] or "login9" in row]


def test_whom_the_platform_cannot_know_is_named_before_anybody_is_graded(tmp_path):
    class_of(tmp_path, "name,a,b,c,Section,d,e,folder")
    says = r"Canvas cannot know .*: give roster.csv a column ID or SIS Login ID"
    with pytest.raises(Robo47Error, match=says):
        known(CANVAS, find_students(tmp_path))


@pytest.mark.parametrize("twice", ["7", "007@X.org"])
def test_two_students_of_one_name_there_are_named_before_anybody_is_graded(
    tmp_path, twice
):
    table = f"name,folder,ID,email\nMia,a,{twice},{twice}\nTom,b,{twice.lower()},c\n"
    (tmp_path / "roster.csv").write_text(table, "utf-8")
    with pytest.raises(Robo47Error, match="Canvas cannot tell Mia from Tom: both have"):
        known(CANVAS, find_students(tmp_path))


def test_the_teachers_guide_shows_what_is_written(tmp_path):
    guide = (ROOT / "docs" / "teaching.md").read_text("utf-8")
    tables = re.findall(r"```text\n((?:Student|ID number),.*?)```", guide, re.DOTALL)
    roster, canvas, moodle = tables
    (tmp_path / "roster.csv").write_text(roster)
    class_ = list(map(GradedStudent, find_students(tmp_path), (result(7), result(8))))
    for platform, title, table in (
        (CANVAS, "Lab {day}", canvas),
        (MOODLE, "Day {day}", moodle),
    ):
        content = for_platform(platform, [Course(find_day(1), class_)], title)
        assert content.decode("utf-8-sig") == table
