"""Several days of a class as one: a table that a learning platform can import.

Of each student and day the marks are kept, which many share, and none of the texts: a
week takes the memory of a day.
"""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field, replace

from labkit.grade import overview
from labkit.grade.overview import Course
from labkit.grade.result import UNGRADED
from labkit.grade.roster import Student
from labkit.grade.sheet import Graded, percent_of, plain, table, who
from labkit.lesson.day import Day

STATES = ("done", "under way", "stuck", "does not load", "not started", UNGRADED)
MISTAKES = 3  # of each day, the most common


@dataclass
class Week:
    """A class over several days, filled in day by day.

    Attributes:
        students: in the order to show them.
        days: those that are graded.
        graded: by the day's number and the student's folder.
        mistakes: by day: task, name and number of students.
    """

    students: Sequence[Student]
    days: list[Day] = field(default_factory=list)
    graded: dict[tuple[int, str], Graded] = field(default_factory=dict)
    mistakes: dict[int, list[tuple[str, str, int]]] = field(default_factory=dict)

    def add(self, course: Course) -> None:
        """Take over a day, without the texts."""
        day = course.day
        self.days.append(day)
        for graded in course.class_:
            bare = replace(graded, result=replace(graded.result, text=""))
            self.graded[day.number, graded.student.folder] = bare
        found = overview.diagnoses(day, course.class_)[:MISTAKES]
        self.mistakes[day.number] = [(d.task, d.mistake, len(d.who)) for d in found]

    def of(self, student: Student) -> list[Graded]:
        """Return a student's days, in order."""
        return [self.graded[day.number, student.folder] for day in self.days]

    def percent(self, student: Student) -> float | None:
        """Return the share of all tasks that pass; None where a day is ungraded."""
        days = self.of(student)
        if any(one.percent is None for one in days):
            return None
        tasks = max(1, sum(len(one.result.tasks) for one in days))
        return 100 * sum(one.tasks_passed for one in days) / tasks

    def counts(self, day: Day) -> Counter[str]:
        """Return how many students are in each state on a day."""
        everybody = (self.graded[day.number, s.folder] for s in self.students)
        return Counter(map(overview.state, everybody))


def as_csv(week: Week) -> bytes:
    """Return the table: a row per student, grades in per cent of the tasks.

    A grade is empty where somebody's work could not be looked at: a platform leaves
    such a grade as it is.
    """
    return table([_row(week, student) for student in week.students])


def _row(week: Week, student: Student) -> dict[str, str | int]:
    days = dict(zip((day.number for day in week.days), week.of(student), strict=True))
    results = [one.result for one in days.values()]
    errors = [f"day {n}: {one.error}" for n, one in days.items() if one.error]
    return {
        **who(student),
        "percent": percent_of(week.percent(student)),
        **{f"day{n}_percent": percent_of(one.percent) for n, one in days.items()},
        **{f"day{n}_deliverables": one.result.score[1] for n, one in days.items()},
        **{
            f"day{n}_late_{unit}": one.late_by[i]
            for n, one in days.items()
            for i, unit in enumerate(("minutes", "days"))
        },
        "kit": plain(", ".join(sorted({one.kit for one in results} - {""}))),
        "seed": plain(", ".join(sorted({str(one.seed) for one in results if one.kit}))),
        "error": plain("; ".join(errors)),
    }
