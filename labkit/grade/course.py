"""A class's grades: a student's day, everybody's, and what share of tasks passes."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import KW_ONLY, dataclass, replace

from labkit.grade.result import UNGRADED, Mark, Result
from labkit.grade.roster import Student
from labkit.grade.similar import Group
from labkit.lesson.day import Day
from labkit.report.generic_verdicts import UNNAMED

UNKNOWN = "unknown"


@dataclass(frozen=True)
class GradedStudent:
    """One student with all that the table and the page show."""

    student: Student  # the student, read from the roster
    result: Result  # the grade; without its text, where a class is held
    _: KW_ONLY
    commit: str = ""  # the hash of the last commit, or ""
    branch: str = ""  # the branch of the clone, or ""
    # The time from the commit to the deadline by the student's own clock, negative past
    # it; None without a commit.
    minutes: int | None = None
    note: str = ""  # an addition to the result's error, as of a failed pull
    fault: bool = False  # this machine failed; the next run grades the student
    hidden: tuple[str, ...] = ()  # tasks that pass without showing in the file's text
    # The number of commits after the deadline; None without one.
    late: int | None = None

    @property
    def error(self) -> str:
        """The reason if something could not be graded or updated, else ""."""
        return "; ".join(filter(None, (self.result.error, self.note)))

    @property
    def state(self) -> str:
        """The student's state in one to three words, as the pages list it."""
        tasks = self.result.tasks
        if any(task.status == UNGRADED for task in tasks):
            return UNGRADED
        if all(task.passed for task in tasks):
            return "done"
        if self.result.does_not_load:
            return "does not load"
        if self.result.is_elsewhere:
            return "elsewhere"
        if self.result.first_mistake:
            return "stuck"
        return "under way" if any(task.passed for task in tasks) else "not started"

    @property
    def late_by(self) -> tuple[int | str | None, int | str | None]:
        """Minutes and begun days from the deadline to the commit that counts.

        UNKNOWN where it has no time that can be, or no commit is there to be read.
        """
        if self.late is None or self.state == UNGRADED:
            return None, None
        if self.minutes is None:
            return UNKNOWN, UNKNOWN
        minutes = max(0, -self.minutes)
        return minutes, -(-minutes // (24 * 60))


def percent(*days: GradedStudent) -> str:
    """Return the share of a student's tasks that pass, "87.5".

    A grade is "" where somebody's work could not be looked at: a learning platform
    leaves such a grade as it is.
    """
    tasks = [task for one in days for task in one.result.tasks]
    if any(task.status == UNGRADED for task in tasks):
        return ""
    return f"{100 * sum(task.passed for task in tasks) / max(1, len(tasks)):.1f}"


@dataclass(frozen=True)
class Course:
    """A class on one day."""

    day: Day  # the day, read from the manifest
    class_: Sequence[GradedStudent]  # everybody, in the order to show them
    _: KW_ONLY
    alike: Sequence[Group] = ()  # similar submissions, by folder
    reference: int = 0  # the time to which commit times count, seconds since 1970
    deadline: bool = False  # the reference is the deadline
    seed: int = 0  # the seed of the fresh inputs
    graded_now: int = 0  # the number of new results
    outdated: int = 0  # the number of results of another version of the kit
    odd: str = ""  # a note on lines of the journal that are no result, or ""

    @property
    def counts(self) -> Counter[str]:
        """The number of students in each state."""
        return Counter(graded.state for graded in self.class_)

    def mistakes(self) -> list[tuple[Mark, list[str]]]:
        """Return the mistakes of the class, the most common first, then the unnamed.

        A mistake counts where it was made: in a task that builds on no other open one.
        It counts once per student.

        Returns:
            Each as a mark in the task in which most made it, with what one of them was
            told, and the names of all.
        """
        made: dict[str, list[tuple[Mark, str]]] = {}
        for graded in self.class_:
            for name, mark in self._roots(graded.result).items():
                made.setdefault(name, []).append((mark, graded.student.name))
        found = []
        for some in made.values():
            ((most, _),) = Counter(mark.id for mark, _ in some).most_common(1)
            found.append((replace(some[0][0], id=most), [who for _, who in some]))
        return sorted(found, key=_rank)

    def _roots(self, result: Result) -> dict[str, Mark]:
        """Return a student's mistakes in tasks whose needs are all passed, by name."""
        marks = {mark.id: mark for mark in result.tasks}
        roots: dict[str, Mark] = {}
        for task in self.day.tasks:
            mark = marks.get(task.id)
            if mark is None or not mark.is_mistake or result.does_not_load:
                continue
            if all(marks[need].passed for need in task.needs if need in marks):
                roots.setdefault(mark.mistake, mark)
        return roots


def by_student(courses: Sequence[Course]) -> list[tuple[GradedStudent, ...]]:
    """Return the days of each student, in the roster's order."""
    return list(zip(*(course.class_ for course in courses), strict=True))


def _rank(found: tuple[Mark, list[str]]) -> tuple[bool, int, str, str]:
    """Return what orders mistakes: what can be explained first, then by how many."""
    mark, who = found
    return mark.mistake in UNNAMED, -len(who), mark.id, mark.mistake
