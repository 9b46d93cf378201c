"""Grade a class from start to end: who, what they hand in, grades, what to write."""

from array import array
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from tqdm import tqdm

from labkit.base.git import GitError
from labkit.base.text import visible
from labkit.grade import page, similar
from labkit.grade.engine import Engine, Key, grade_all
from labkit.grade.journal import Journal
from labkit.grade.overview import Course
from labkit.grade.package import Package, collect
from labkit.grade.pull import pull_all
from labkit.grade.result import Result, ungraded
from labkit.grade.roster import Student, file_names
from labkit.grade.sheet import Graded, as_csv, nameless, write, write_feedback
from labkit.lesson.day import Day
from labkit.lesson.starter import make_starter, read_script
from labkit.sandbox.library import file_of
from robo47.errors import FaultError
from robo47.paths import shown

FAULT = "this machine failed ({}); the same command tries again"


@dataclass
class Classroom:
    """One class on the way to its grades, for one day or more.

    Attributes:
        students: from the roster.
        days: from the kit's manifests.
        journal: results so far.
        again: folders to grade though they have a result; None is everybody.
        frozen: what another version of the kit gave stays.
        keep: "last", or "best" of all results of somebody.
        notes: what to add to a student's error, by folder.
        graded_now: how many results are new.
        faults: how many are none, since this machine or a worker failed.
    """

    students: Sequence[Student]
    days: Sequence[Day]
    journal: Journal
    again: Collection[str] | None = ()
    frozen: bool = False
    keep: str = "last"
    notes: dict[str, str] = field(default_factory=dict)
    graded_now: int = 0
    faults: int = 0

    def __post_init__(self) -> None:
        """Name everybody's file."""
        self._files = file_names(student.folder for student in self.students)
        self._students = {student.folder: student for student in self.students}
        self._days = {day.number: day for day in self.days}

    def pull(self) -> None:
        """Clone and update; who cannot be updated is graded as they are."""
        with _bar(len(self.students), "pulling") as bar:
            for student, problem in pull_all(list(self.students)):
                if problem:
                    self.notes[student.folder] = f"not pulled: {problem}"
                bar.update()

    def grade(self, engine: Engine, feedback: Path) -> list[Course]:
        """Grade everybody whose work has changed.

        Args:
            engine: where to.
            feedback: folder of the students' files.

        Returns:
            For each day everybody, in the roster's order, and who writes alike.

        Raises:
            Robo47Error: no worker is left, or a file cannot be written.
        """
        graded: dict[Key, Graded] = {}
        runs: dict[Key, list[array[int]]] = {}
        compare = {day.number: _comparer(day) for day in self.days}
        due = self.journal.reference if self.journal.deadline else None
        kept = self.frozen or bool(self.again)

        def note(key: Key, package: Package, result: Result | FaultError) -> None:
            graded[key] = self._graded(key, package, result)
            write_feedback(feedback, graded[key])
            bar.update()

        def changed() -> Iterator[tuple[Key, Package]]:
            for key in ((d, f) for d in self._days for f in self._students):
                day, student = self._days[key[0]], self._students[key[1]]
                try:
                    package = collect(student, day, self.journal.seed, due)
                except (OSError, GitError, MemoryError) as error:
                    fault = FaultError(visible(error) or type(error).__name__)
                    note(key, Package(day.number, ""), fault)
                    continue
                runs[key] = compare[day.number](package)
                known = self.journal.find(student.folder, package, frozen=kept)
                if known and not (self.again is None or key[1] in self.again):
                    note(key, package, known)
                else:
                    yield key, package

        with _bar(len(self.students) * len(self.days), "grading") as bar:
            for key, package, result in grade_all(changed(), engine):
                if isinstance(result, Result):
                    result = result.lean()
                    self.journal.keep(key[1], package, result)
                    self.graded_now += 1
                note(key, package, result)
        return [self._course(day, graded, runs) for day in self.days]

    def _graded(
        self, key: Key, package: Package, result: Result | FaultError
    ) -> Graded:
        day, student = self._days[key[0]], self._students[key[1]]
        fault, late = isinstance(result, FaultError), package.late
        if isinstance(result, FaultError):  # not kept, so that it is tried again
            self.faults += 1
            result = ungraded(day, FAULT.format(visible(result, 200)))
        elif self.keep == "best":
            result, package = self.journal.best(student.folder, package)
        minutes = None
        if package.committed is not None:
            minutes = (self.journal.reference - package.committed) // 60
        note, file = self.notes.get(student.folder, ""), self._files[student.folder]
        facts = (package.commit, minutes, note, fault, file)
        due = self.journal.deadline
        return Graded(student, result, *facts, late if due else None)

    def _course(
        self,
        day: Day,
        graded: Mapping[Key, Graded],
        runs: Mapping[Key, list["array[int]"]],
    ) -> Course:
        own = {f: r for (number, f), r in runs.items() if number == day.number}
        alike = similar.like_the_kit(own, _runs_of_kit(day))
        alike += similar.similar_groups({f: r[0] for f, r in own.items() if r})
        everybody = [graded[day.number, folder] for folder in self._students]
        journal = self.journal
        facts = (journal.reference, journal.deadline, journal.seed)
        return Course(day, everybody, alike, *facts)


def write_all(course: Course, out: Path, *, anonymous: bool = False) -> None:
    """Write a day's tables and page.

    Args:
        course: everybody's grades for a day.
        out: the table; the others go beside it.
        anonymous: write a table for handing on, too.

    Raises:
        Robo47Error: one of them cannot be written.
    """
    write(out, as_csv(course.day, course.class_))
    if anonymous:
        content = as_csv(course.day, nameless(course.class_, course.seed))
        write(out.with_stem(f"{out.stem}-anonymous"), content)
    write(out.parent / "class.html", page.render(course).encode("utf-8"))


def _starter(day: Day) -> str:
    return make_starter(read_script(day.source), shown(day.source), day.number)


def _runs_of_kit(day: Day) -> "array[int]":
    """Return the runs of a day's solution and of the library's modules that hold it."""
    files = [day.source, *map(file_of, day.library)]
    texts = "\n".join(map(read_script, files))
    return similar.runs_of(texts.encode(), _starter(day))


def _comparer(day: Day) -> Callable[[Package], list["array[int]"]]:
    """Return what makes of files what `similar` compares, the script's first."""
    starter = _starter(day)

    def compare(package: Package) -> list["array[int]"]:
        files = package.modules()
        names = sorted(files, key=lambda name: name != day.script)
        return [similar.runs_of(files[name], starter) for name in names]

    return compare


def _bar(total: int, doing: str) -> "tqdm[None]":
    return tqdm(
        total=total, desc=doing, unit="student", leave=False, delay=1, disable=None
    )
