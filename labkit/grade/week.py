"""Several days of a class as one: a table that a learning platform can import.

Of each student and day only a few numbers are kept, so a week takes the memory of a
day.
"""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field

from labkit.grade import overview
from labkit.grade.overview import Course
from labkit.grade.result import UNGRADED
from labkit.grade.roster import Student
from labkit.grade.sheet import percent_of, plain, printable, table
from labkit.lesson.day import Day

STATES = ("done", "under way", "stuck", "does not load", "not started", UNGRADED)
MISTAKES = 3  # of each day, the most common


@dataclass(frozen=True)
class Standing:
    """One student on one day.

    Attributes:
        passed: how many tasks pass; side quests are not counted.
        tasks: of how many.
        handed_in: how many deliverables pass.
        items: of how many.
        state: one of STATES.
        error: why something could not be graded.
        late_by: minutes and begun days after the deadline, "" without one.
        kit: version of the kit that graded it.
        seed: of its fresh inputs, "" where nothing was graded.
    """

    passed: int
    tasks: int
    handed_in: int
    items: int
    state: str
    error: str
    late_by: tuple[int, int] | tuple[str, str] = ("", "")
    kit: str = ""
    seed: int | str = ""

    @property
    def percent(self) -> float | None:
        """The share of tasks that pass; None where nobody could look at them."""
        return (
            None if self.state == UNGRADED else 100 * self.passed / max(1, self.tasks)
        )


@dataclass
class Week:
    """A class over several days, filled in day by day.

    Attributes:
        students: in the order to show them.
        days: those that are graded.
        standings: by the day's number and the student's folder.
        mistakes: by day: task, name and number of students.
    """

    students: Sequence[Student]
    days: list[Day] = field(default_factory=list)
    standings: dict[tuple[int, str], Standing] = field(default_factory=dict)
    mistakes: dict[int, list[tuple[str, str, int]]] = field(default_factory=dict)

    def add(self, course: Course) -> None:
        """Take over a day, without the texts."""
        day = course.day
        self.days.append(day)
        for graded in course.class_:
            result = graded.result
            self.standings[day.number, graded.student.folder] = Standing(
                graded.tasks_passed,
                len(result.tasks),
                sum(item.passed for item in result.items),
                len(result.items),
                overview.state(graded),
                graded.error,
                graded.late_by,
                result.kit,
                result.seed if result.kit else "",
            )
        found = overview.diagnoses(day, course.class_)[:MISTAKES]
        self.mistakes[day.number] = [(d.task, d.mistake, len(d.who)) for d in found]

    def of(self, student: Student) -> list[Standing]:
        """Return a student's days, in order."""
        return [self.standings[day.number, student.folder] for day in self.days]

    def percent(self, student: Student) -> float | None:
        """Return the share of all tasks that pass; None where a day is ungraded."""
        days = self.of(student)
        if any(one.percent is None for one in days):
            return None
        tasks = max(1, sum(one.tasks for one in days))
        return 100 * sum(one.passed for one in days) / tasks

    def counts(self, day: Day) -> Counter[str]:
        """Return how many students are in each state on a day."""
        return Counter(
            self.standings[day.number, s.folder].state for s in self.students
        )


def columns(days: Sequence[Day]) -> list[str]:
    """Return the table's columns."""
    numbers = [day.number for day in days]
    percent = [f"day{n}_percent" for n in numbers]
    handed_in = [f"day{n}_deliverables" for n in numbers]
    late = [f"day{n}_late_{unit}" for n in numbers for unit in ("minutes", "days")]
    every = [*percent, *handed_in, *late]
    return ["id", "name", "folder", "percent", *every, "kit", "seed", "error"]


def as_csv(week: Week) -> bytes:
    """Return the table: a row per student, grades in per cent of the tasks.

    A grade is empty where somebody's work could not be looked at: a platform leaves
    such a grade as it is.
    """
    rows = [_cells(week, student) for student in week.students]
    return table(columns(week.days), rows)


def _cells(week: Week, student: Student) -> list[str | int]:
    days = week.of(student)
    errors = [
        f"day {day.number}: {one.error}"
        for day, one in zip(week.days, days, strict=True)
        if one.error
    ]
    return [
        plain(student.id),
        plain(student.name),
        plain(printable(student.folder)),
        percent_of(week.percent(student)),
        *(percent_of(one.percent) for one in days),
        *(one.handed_in for one in days),
        *(late for one in days for late in one.late_by),
        plain(", ".join(sorted({one.kit for one in days} - {""}))),
        plain(", ".join(sorted({str(one.seed) for one in days} - {""}))),
        plain("; ".join(errors)),
    ]
