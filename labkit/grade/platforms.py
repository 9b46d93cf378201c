"""The grades as learning platforms import them: Canvas and Moodle.

Sources: Canvas' importer (github.com/instructure/canvas-lms, lib/gradebook_importer.rb)
and its users' guides (teaching.resources.osu.edu, "Import a CSV File to Carmen
Grades"); docs.moodle.org/405/en/Grade_import.
"""

from collections.abc import Sequence
from dataclasses import dataclass

from labkit.grade.course import Course, by_student, percent
from labkit.grade.roster import Student
from labkit.grade.sheet import lines_of, plain
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


def as_csv(platform: Platform, courses: Sequence[Course], title: str) -> bytes:
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
            about = [_cell(platform, student, name) for name in platform.columns]
            rows.append([*about, *map(percent, days)])
    return lines_of(rows)


def _cell(platform: Platform, student: Student, column: str) -> str:
    """Return what the roster has in a platform's column, "" for nothing."""
    names = (column.lower(), *platform.columns[column])
    found = next((student.cells[n] for n in names if student.cells.get(n)), "")
    return plain(found or (student.name if column == "Student" else ""))
