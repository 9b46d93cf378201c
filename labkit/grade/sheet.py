"""The grades as tables, one row per student; those that learning platforms import, too.

Sources: Canvas' importer (github.com/instructure/canvas-lms, lib/gradebook_importer.rb)
and its users' guides (teaching.resources.osu.edu, "Import a CSV File to Carmen
Grades"); docs.moodle.org/405/en/Grade_import.
"""

import csv
import hashlib
import io
import os
import re
import unicodedata
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from labkit.base import store
from labkit.base.text import visible
from labkit.grade.course import UNKNOWN, Course, GradedStudent, by_student, percent
from labkit.grade.result import Mark
from labkit.grade.roster import Student
from robo47.errors import Robo47Error
from robo47.paths import shown

# A spreadsheet runs a text that begins like this as a formula, in wide letters, too.
_FORMULA = re.compile(r"\s*['=+@|%-]")
Cell = str | int | None
# Where half the world's spreadsheets split, and what reads alike: what stands behind it
# would be a cell of its own, and may be a formula.
_SEPARATORS = {"; ": " – ", ";": ",", "|": "¦"}


def as_csv(class_: Sequence[GradedStudent]) -> bytes:
    """Return the table of a day.

    Args:
        class_: everybody, in the order to show them.

    Returns:
        CSV in UTF-8 with a byte order mark, by which spreadsheets know it.
    """
    rows = list(map(_row, class_))
    return _csv([rows[0], *(row.values() for row in rows)])


def of_days(courses: Sequence[Course]) -> bytes:
    """Return the table of several days: a row per student, in per cent of the tasks."""
    numbers = [course.day.number for course in courses]
    rows = [_row_of_days(numbers, days) for days in by_student(courses)]
    return _csv([rows[0], *(row.values() for row in rows)])


def table(rows: Sequence[dict[str, Cell]]) -> bytes:
    """Return a table of rows that have the same columns; words in it are plain."""
    cells = [
        [plain(cell) if isinstance(cell, str) else cell for cell in row.values()]
        for row in rows
    ]
    return _csv([rows[0], *cells])


def _csv(rows: Iterable[Iterable[Cell]]) -> bytes:
    """Return rows of cells as CSV, a cell that is None as an empty one."""
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows(rows)
    return text.getvalue().encode("utf-8-sig")


def nameless(class_: Sequence[GradedStudent], seed: int) -> list[GradedStudent]:
    """Return a class in an order and with names that say nothing of who it is.

    Args:
        class_: everybody.
        seed: of the grading, by which the same person has the same name every day.
    """
    found = []
    for graded in class_:
        whose = os.fsencode(f"{seed} {graded.student.folder}")
        code = hashlib.sha256(whose).hexdigest()[:8]
        marks = [replace(mark, message="") for mark in graded.result.tasks]
        result = replace(graded.result, tasks=tuple(marks), error="", refused=())
        student = Student(code, code, Path())
        bare = replace(graded, student=student, result=result, commit="", note="")
        bare = replace(bare, branch="")
        found.append(bare)
    return sorted(found, key=lambda graded: graded.student.name)


def _row(graded: GradedStudent) -> dict[str, Cell]:
    result = graded.result
    mistake = graded.result.first_mistake or Mark("", "")
    minutes, days = graded.late_by
    no_time = graded.commit and graded.minutes is None
    return {
        **_who(graded.student),
        "percent": percent(graded),
        "tasks_passed": result.score[0],
        **{task.id: task.shown for task in result.tasks},
        "deliverables_passed": result.score[1],
        **{item.id: item.status for item in result.items},
        "first_mistake": plain(f"{mistake.id} {mistake.mistake}"),
        "what_it_says": plain(mistake.message),
        "minutes_since_commit_own_clock": UNKNOWN if no_time else graded.minutes,
        "late_minutes": minutes,
        "late_days": days,
        "commits_after_deadline": graded.late,
        "commit_hash": graded.commit[:10],
        "branch": plain(graded.branch),
        "kit": result.kit,
        "seed": result.seed if result.kit else None,
        "refused": plain("; ".join(result.refused)),
        "error": plain(graded.error),
    }


def _row_of_days(
    numbers: Sequence[int], class_: Sequence[GradedStudent]
) -> dict[str, Cell]:
    days = dict(zip(numbers, class_, strict=True))
    results = [one.result for one in class_]
    errors = [f"day {n}: {one.error}" for n, one in days.items() if one.error]
    return {
        **_who(class_[0].student),
        "percent": percent(*class_),
        **{f"day{n}_percent": percent(one) for n, one in days.items()},
        **{f"day{n}_deliverables": one.result.score[1] for n, one in days.items()},
        **{
            f"day{n}_late_{unit}": late
            for n, one in days.items()
            for unit, late in zip(("minutes", "days"), one.late_by, strict=True)
        },
        "kit": plain(", ".join(sorted({one.kit for one in results} - {""}))),
        "seed": plain(", ".join(sorted({str(one.seed) for one in results if one.kit}))),
        "error": plain("; ".join(errors)),
    }


def _who(student: Student) -> dict[str, Cell]:
    who = {"id": student.id, "name": student.name, "folder": student.folder}
    return {column: plain(text) for column, text in who.items()}


@dataclass(frozen=True)
class Platform:
    """The format of a platform's import."""

    name: str  # the name that its makers use
    # The columns of the file before the grades, in order. The roster's columns have the
    # same names, in letters of any size, or the other names here.
    columns: dict[str, tuple[str, ...]]
    known_by: tuple[str, ...]  # the columns that identify a student
    points: str = ""  # the beginning of the row with the most points, if there is one


PLATFORMS = {
    "canvas": Platform(
        "Canvas",
        {"Student": (), "ID": (), "SIS Login ID": ("login",), "Section": ()},
        ("ID", "SIS Login ID"),
        "    Points Possible",
    ),
    "moodle": Platform(
        "Moodle",
        {"ID number": ("id", "number"), "Email address": ("email",)},
        ("ID number", "Email address"),
    ),
}


def known(platform: Platform, students: Sequence[Student]) -> None:
    """Check that a platform can find everybody, before anybody is graded.

    Raises:
        Robo47Error: somebody's row of the roster does not say as whom, or says the same
            as another's: the platform would give one of them the other's grade.
    """
    for student in students:
        if not any(_as_known(platform, student, name) for name in platform.known_by):
            asked = " or ".join(platform.known_by)
            raise Robo47Error(
                f"{platform.name} cannot know {student.name}: give roster.csv a column "
                f"{asked}, with what the platform's own export has there"
            )
    for name in platform.known_by:
        of: dict[str, Student] = {}
        for student in students:
            key = _as_known(platform, student, name)
            other = of.setdefault(key.casefold(), student) if key else student
            if other is not student:
                raise Robo47Error(
                    f"{platform.name} cannot tell {other.name} from {student.name}: "
                    f"both have {key} in the roster's column {name}. Correct the roster"
                )


def for_platform(platform: Platform, courses: Sequence[Course], title: str) -> bytes:
    """Return the table for a platform, grades in per cent of the tasks.

    Whoever could not be graded has no row: an empty grade would wipe one out.

    Args:
        platform: of PLATFORMS.
        courses: the graded days of a class.
        title: of a day's column, as the assignment is called there: "Lab {day}".
    """
    titles = [title.replace("{day}", str(course.day.number)) for course in courses]
    rows = [[*platform.columns, *map(plain, titles)]]
    if platform.points:
        blank = [""] * (len(platform.columns) - 1)
        rows.append([platform.points, *blank, *(["100"] * len(titles))])
    for days in by_student(courses):
        if percent(*days):
            student = days[0].student
            about = [_as_known(platform, student, name) for name in platform.columns]
            rows.append([*about, *map(percent, days)])
    return _csv(rows)


def _as_known(platform: Platform, student: Student, column: str) -> str:
    """Return what the roster has in a platform's column, "" for nothing."""
    names = (column.lower(), *platform.columns[column])
    found = next((student.cells[n] for n in names if student.cells.get(n)), "")
    return plain(found or (student.name if column == "Student" else ""))


def plain(text: str) -> str:
    """Return a text that any spreadsheet shows as it is, in one cell, on one line."""
    line = visible(printable(text), 2000)
    for separator, alike in _SEPARATORS.items():
        line = line.replace(separator, alike).strip()
    narrow = unicodedata.normalize("NFKC", line[:9])
    return f"'{line}" if _FORMULA.match(narrow) else line


def printable(text: str) -> str:
    """Return a text that UTF-8 can hold: a folder's name may be any bytes."""
    return text.encode("utf-8", "backslashreplace").decode("utf-8")


def write(path: Path, content: bytes) -> None:
    """Replace a file whole, or leave it as it was; nothing to do where it is equal.

    Raises:
        Robo47Error: it cannot be written.
    """
    try:
        if path.is_file() and path.read_bytes() == content:
            return
        path.parent.mkdir(parents=True, exist_ok=True)
        store.replace(path, content, sync=True)
    except OSError as error:
        raise Robo47Error(
            f"{shown(path)} cannot be written: {error.strerror or error}. Close it "
            "where it is open, or choose another place with --out"
        ) from None
