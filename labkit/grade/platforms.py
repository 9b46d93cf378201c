"""The grades as learning platforms import them: Canvas and Moodle.

Sources: Canvas' importer (github.com/instructure/canvas-lms, lib/gradebook_importer.rb)
and its users' guides (teaching.resources.osu.edu, "Import a CSV File to Carmen
Grades"); docs.moodle.org/405/en/Grade_import.
"""

from collections.abc import Sequence
from dataclasses import dataclass

from labkit.grade.roster import Student
from labkit.grade.sheet import csv_of, percent_of, plain
from labkit.grade.week import Week
from robo47.errors import Robo47Error


@dataclass(frozen=True)
class Platform:
    """What a platform's import asks for.

    Attributes:
        name: as its makers write it.
        columns: of the file, before the grades, in order; the roster's are called the
            same, in letters of any size, or by the other names here.
        known_by: by one of these columns it finds a student.
        points: how a row begins that says what a grade is out of; "" where none does.
    """

    name: str
    columns: dict[str, tuple[str, ...]]
    known_by: tuple[str, ...]
    points: str = ""


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
        Robo47Error: somebody's row of the roster does not say as whom.
    """
    for student in students:
        if not any(_cell(platform, student, name) for name in platform.known_by):
            asked = " or ".join(platform.known_by)
            raise Robo47Error(
                f"{platform.name} cannot know {student.name}: give roster.csv a column "
                f"{asked}, with what the platform's own export has there"
            )


def as_csv(platform: Platform, week: Week, title: str) -> bytes:
    """Return the table for a platform, grades in per cent of the tasks.

    Whoever could not be graded has no row: an empty grade would wipe one out.

    Args:
        platform: of PLATFORMS.
        week: the graded days.
        title: of a day's column, as the assignment is called there: "Lab {day}".
    """
    head = [title.replace("{day}", str(day.number)) for day in week.days]
    rows = []
    if platform.points:
        blank = [""] * (len(platform.columns) - 1)
        rows.append([platform.points, *blank, *(["100"] * len(head))])
    for student in week.students:
        grades = [one.percent for one in week.of(student)]
        if None not in grades:
            about = [_cell(platform, student, name) for name in platform.columns]
            rows.append([*about, *map(percent_of, grades)])
    return csv_of([*platform.columns, *map(plain, head)], rows)


def _cell(platform: Platform, student: Student, column: str) -> str:
    """Return what the roster has in a platform's column, "" for nothing."""
    names = (column.lower(), *platform.columns[column])
    found = next((student.cells[n] for n in names if student.cells.get(n)), "")
    return plain(found or (student.name if column == "Student" else ""))
