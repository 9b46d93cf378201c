"""Grade a class from start to end: who, what they hand in, grades, what to write."""

from array import array
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from tqdm import tqdm

from robo47.checker.deliverables.commit import wanted_files
from robo47.grading import page, similar
from robo47.grading.collect import collect
from robo47.grading.course import Course
from robo47.grading.engine import Engine, LostError, grade_all
from robo47.grading.feedback import write_feedback
from robo47.grading.journal import Journal
from robo47.grading.package import Package
from robo47.grading.pull import pull_all
from robo47.grading.result import Result, ungraded
from robo47.grading.roster import Student
from robo47.grading.sheet import Graded, as_csv, write
from robo47.grading.similar import Group
from robo47.lesson.day import Day
from robo47.lesson.starter import make_starter, read_script
from robo47.paths import shown

LOST = "the workers that graded it were lost; run the same command again"


@dataclass
class Classroom:
    """One class and one day, on the way to its grades.

    Attributes:
        students: from the roster.
        day: from the kit's manifest.
        journal: results so far.
        again: grade those too that have a result.
        notes: what to add to a student's error, by folder.
        graded_now: how many this run graded.
        lost: how many it could not, for want of workers.
    """

    students: Sequence[Student]
    day: Day
    journal: Journal
    again: bool = False
    notes: dict[str, str] = field(default_factory=dict)
    graded_now: int = 0
    lost: int = 0

    def pull(self) -> None:
        """Clone and update; who cannot be updated is graded as they are."""
        with _bar(len(self.students), "pulling") as bar:
            for student, problem in pull_all(list(self.students)):
                if problem:
                    self.notes[student.folder] = f"not pulled: {problem}"
                bar.update()

    def grade(self, engine: Engine, feedback: Path) -> tuple[list[Graded], list[Group]]:
        """Grade everybody whose work has changed.

        Args:
            engine: where to.
            feedback: folder of the students' files.

        Returns:
            Everybody, in the roster's order, and the groups of similar submissions.

        Raises:
            Robo47Error: no worker is left, or a file cannot be written.
        """
        by_folder = {student.folder: student for student in self.students}
        graded: dict[str, Graded] = {}
        runs = {}
        look = _comparer(self.day)

        def note(folder: str, package: Package, result: Result) -> None:
            graded[folder] = self._graded(by_folder[folder], package, result)
            write_feedback(feedback, graded[folder])
            bar.update()

        def changed() -> Iterator[tuple[str, Package]]:
            for folder, student in by_folder.items():
                package = collect(student, self.day)
                runs[folder] = look(package)
                known = self.journal.find(folder, package)
                if known and not self.again:
                    note(folder, package, known)
                else:
                    yield folder, package

        with _bar(len(self.students), "grading") as bar:
            for folder, package, result in grade_all(changed(), engine):
                note(folder, package, self._kept(folder, package, result))
        return [graded[key] for key in by_folder], similar.similar_groups(runs)

    def _kept(
        self, folder: str, package: Package, result: Result | LostError
    ) -> Result:
        """Keep a result; one that was lost is not kept, so that it is tried again."""
        if isinstance(result, LostError):
            self.lost += 1
            return ungraded(self.day, LOST)
        self.journal.keep(folder, package, result)
        self.graded_now += 1
        return result

    def _graded(self, student: Student, package: Package, result: Result) -> Graded:
        minutes = None
        if package.committed is not None:
            minutes = (self.journal.reference - package.committed) // 60
        note = self.notes.get(student.folder, "")
        return Graded(student, result, package.commit, minutes, note)


def write_all(
    room: Classroom, everybody: Sequence[Graded], alike: Sequence[Group], out: Path
) -> None:
    """Write the table and the page.

    Args:
        room: the class.
        everybody: in the order to show them.
        alike: similar submissions.
        out: the table; the page goes beside it.

    Raises:
        Robo47Error: one of them cannot be written.
    """
    journal = room.journal
    course = Course(room.day, everybody, alike, journal.reference, journal.deadline)
    write(out, as_csv(room.day, everybody))
    write(out.parent / "class.html", page.render(course).encode("utf-8"))


def _comparer(day: Day) -> Callable[[Package], "array[int]"]:
    """Return what makes of a package's script what `similar` compares."""
    starter = make_starter(read_script(day.source), shown(day.source), day.number)
    script = wanted_files(day)[0]
    return lambda package: similar.runs_of(package.files.get(script, b""), starter)


def _bar(total: int, doing: str) -> "tqdm[None]":
    return tqdm(total=total, desc=doing, unit="student", leave=False, delay=1)
