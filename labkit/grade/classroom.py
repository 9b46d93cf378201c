"""Grade a class from start to end: who, what they hand in, grades, what to write."""

from array import array
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from tqdm import tqdm

from labkit.base.git import GitError
from labkit.base.text import visible
from labkit.grade import page, similar
from labkit.grade.engine import Engine, grade_all
from labkit.grade.journal import Journal
from labkit.grade.overview import Course
from labkit.grade.package import Package, collect
from labkit.grade.pull import pull_all
from labkit.grade.result import Result, ungraded
from labkit.grade.roster import Student, file_names
from labkit.grade.sheet import Graded, as_csv, nameless, write, write_feedback
from labkit.lesson.day import Day
from labkit.lesson.script import read_script, starter_of
from labkit.sandbox.messages import file_of
from robo47.errors import FaultError

FAULT = "this machine failed ({}); the same command tries again"


@dataclass
class Tally:
    """What is said at the end of all days.

    Attributes:
        graded_now: how many results are new.
        faults: how many are none, since this machine or a worker failed.
        outdated: how many another version of the kit had given.
        odd: on lines of journals that are no result.
        notes: what to add to a student's error, by folder.
    """

    graded_now: int = 0
    faults: int = 0
    outdated: int = 0
    odd: list[str] = field(default_factory=list)
    notes: dict[str, str] = field(default_factory=dict)


@dataclass
class Classroom:
    """One class on the way to its grades for a day.

    Attributes:
        students: from the roster.
        day: from the kit's manifest.
        journal: results so far.
        again: folders to grade though they have a result; None is everybody.
        frozen: what another version of the kit gave stays.
        keep: "last", or "best" of all results of somebody.
        tally: where is counted what becomes of them.
    """

    students: Sequence[Student]
    day: Day
    journal: Journal
    again: Collection[str] | None = ()
    frozen: bool = False
    keep: str = "last"
    tally: Tally = field(default_factory=Tally)

    def pull(self) -> None:
        """Clone and update; who cannot be updated is graded as they are."""
        with _bar(len(self.students), "pulling") as bar:
            for student, problem in pull_all(list(self.students)):
                if problem:
                    self.tally.notes[student.folder] = f"not pulled: {problem}"
                bar.update()

    def grade(self, engine: Engine, feedback: Path) -> Course:
        """Grade everybody whose work has changed.

        Args:
            engine: where to.
            feedback: folder of the students' files.

        Returns:
            Everybody, in the roster's order, and who writes alike.

        Raises:
            Robo47Error: no worker is left, or a file cannot be written.
        """
        graded: dict[str, Graded] = {}
        runs: dict[str, list[array[int]]] = {}
        students = {student.folder: student for student in self.students}
        files, starter = file_names(students), starter_of(self.day)

        def note(folder: str, package: Package, result: Result | FaultError) -> None:
            one = self._graded(students[folder], files[folder], package, result)
            graded[folder] = one
            write_feedback(feedback, one)
            bar.update()

        def changed() -> Iterator[tuple[str, Package]]:
            for folder, student in students.items():
                package = self._collected(student)
                if isinstance(package, FaultError):
                    note(folder, Package(self.day.number, ""), package)
                    continue
                runs[folder] = _runs(package, self.day, starter)
                if known := self._known(folder, package):
                    note(folder, package, known)
                else:
                    yield folder, package

        with _bar(len(students), "grading") as bar:
            for folder, package, result in grade_all(changed(), engine):
                if isinstance(result, Result):
                    result = result.lean()
                    self.journal.keep(folder, package, result)
                    self.tally.graded_now += 1
                note(folder, package, result)
        return self._course([graded[folder] for folder in students], runs)

    def _collected(self, student: Student) -> Package | FaultError:
        due = self.journal.reference if self.journal.deadline else None
        try:
            return collect(student, self.day, self.journal.seed, due)
        except (OSError, GitError, MemoryError) as error:
            return FaultError(visible(error) or type(error).__name__)

    def _known(self, folder: str, package: Package) -> Result | None:
        """Return the result that stays, or None for who is to be graded."""
        kept = self.frozen or bool(self.again)
        known = self.journal.find(folder, package, frozen=kept)
        return None if self.again is None or folder in self.again else known

    def _graded(
        self,
        student: Student,
        file: str,
        package: Package,
        result: Result | FaultError,
    ) -> Graded:
        fault, late = isinstance(result, FaultError), package.late
        if isinstance(result, FaultError):  # not kept, so that it is tried again
            self.tally.faults += 1
            result = ungraded(self.day, FAULT.format(visible(result, 200)))
        elif self.keep == "best":
            result, package = self.journal.best(student.folder, package)
        minutes = None
        if package.committed is not None:
            minutes = (self.journal.reference - package.committed) // 60
        note = self.tally.notes.get(student.folder, "")
        facts = (package.commit, minutes, note, fault, file)
        return Graded(student, result, *facts, late if self.journal.deadline else None)

    def _course(
        self, everybody: Sequence[Graded], runs: Mapping[str, list["array[int]"]]
    ) -> Course:
        alike = similar.like_the_kit(runs, _runs_of_kit(self.day))
        alike += similar.similar_groups({f: r[0] for f, r in runs.items() if r})
        journal = self.journal
        facts = (journal.reference, journal.deadline, journal.seed)
        return Course(self.day, everybody, alike, *facts)


def write_all(course: Course, out: Path, *, anonymous: bool = False) -> None:
    """Write a day's tables and page.

    Args:
        course: everybody's grades for a day.
        out: the table; the others go beside it.
        anonymous: write a table for handing on, too.

    Raises:
        Robo47Error: one of them cannot be written.
    """
    write(out, as_csv(course.class_))
    if anonymous:
        content = as_csv(nameless(course.class_, course.seed))
        write(out.with_stem(f"{out.stem}-anonymous"), content)
    write(out.parent / "class.html", page.render(course).encode("utf-8"))


def _runs_of_kit(day: Day) -> "array[int]":
    """Return the runs of a day's solution and of the library's modules that hold it."""
    files = [day.source, *(file_of(f"robo47.{name}") for name in day.library)]
    texts = "\n".join(map(read_script, files))
    return similar.runs_of(texts.encode(), starter_of(day))


def _runs(package: Package, day: Day, starter: str) -> list["array[int]"]:
    """Return what `similar` compares of each file, the script's first."""
    files = package.modules()
    names = sorted(files, key=lambda name: name != day.script)
    return [similar.runs_of(files[name], starter) for name in names]


def _bar(total: int, doing: str) -> "tqdm[None]":
    return tqdm(
        total=total, desc=doing, unit="student", leave=False, delay=1, disable=None
    )
