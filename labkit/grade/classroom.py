"""Grade a class from start to end: who, what they hand in, grades, what to write."""

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import KW_ONLY, dataclass, field, replace
from pathlib import Path
from typing import Any

from tqdm import tqdm

from labkit.base.git import GitError
from labkit.base.text import visible
from labkit.grade import page, similar
from labkit.grade.course import Course, GradedStudent
from labkit.grade.engine import Engine, grade_all
from labkit.grade.journal import Journal, StoredResult
from labkit.grade.package import Package, collect
from labkit.grade.pull import pull_all
from labkit.grade.result import FAULT, Result, ungraded
from labkit.grade.roster import Student
from labkit.grade.sheet import as_csv, nameless, printable, write
from labkit.grade.similar import Runs
from labkit.lesson.day import Day
from labkit.lesson.lab_module import read_script
from labkit.lesson.starter import starter_of
from labkit.sandbox.messages import file_of
from robo47.errors import FaultError
from robo47.paths import shown


@dataclass(frozen=True)
class Regrading:
    """The students whose unchanged work is graded again; by default nobody."""

    everybody: bool = False
    folders: Collection[str] = ()  # the folders of those who are graded again

    def asks_for(self, folder: str) -> bool:
        """Return whether a student's work is."""
        return self.everybody or folder in self.folders


@dataclass
class Classroom:
    """One class on the way to its grades for a day."""

    students: Sequence[Student]  # the students, read from the roster
    day: Day  # the day, read from the kit's manifest
    journal: Journal  # results so far
    _: KW_ONLY
    again: Regrading = Regrading()
    frozen: bool = False  # results of another version of the kit stay
    keep: str = "last"  # "last", or "best" of all results of a student
    # Additions to a student's error, by folder.
    notes: Mapping[str, str] = field(default_factory=dict)

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
        graded: dict[str, GradedStudent] = {}
        runs: dict[str, list[Runs]] = {}
        starter = starter_of(self.day)
        now = 0

        def note(one: Student, package: Package, result: Result | FaultError) -> None:
            found = self._graded(one, package, result)
            text = f"{one.name}\n\n{found.result.text}"
            write(feedback / f"{one.file}.txt", printable(text).encode("utf-8"))
            # The text is left out, so that a week takes the memory of a day.
            result = replace(found.result, text="")
            unseen = tuple(_hidden(package, self.day, result))
            graded[one.folder] = replace(found, result=result, hidden=unseen)
            bar.update()

        def changed() -> Iterator[tuple[Student, Package]]:
            for student in self.students:
                package, known = self._stored_result(student)
                runs[student.folder] = _runs(package, self.day, starter)
                if known:
                    note(student, package, known)
                else:
                    yield student, package

        with _bar(len(self.students), "grading") as bar:
            for student, package, result in grade_all(changed(), engine):
                if isinstance(result, Result):
                    self.journal.keep(student.folder, package, result)
                    now += 1
                note(student, package, result)
        return self._course([graded[one.folder] for one in self.students], runs, now)

    def _stored_result(
        self, student: Student
    ) -> tuple[Package, Result | FaultError | None]:
        """Return what is handed in, and its result; None for who is to be graded."""
        due = self.journal.reference if self.journal.deadline else None
        try:
            package = collect(student, self.day, self.journal.seed, due)
        except (OSError, GitError, MemoryError, RecursionError) as error:
            fault = FaultError(visible(error) or type(error).__name__)
            return Package(self.day.number, ""), fault
        kept = self.frozen or bool(self.again.folders)
        known = self.journal.find(student.folder, package, frozen=kept)
        return package, None if self.again.asks_for(student.folder) else known

    def _graded(
        self, student: Student, package: Package, result: Result | FaultError
    ) -> GradedStudent:
        given: Package | StoredResult = package
        fault = isinstance(result, FaultError)
        if isinstance(result, FaultError):  # not kept, so that it is tried again
            result = ungraded(self.day, FAULT.format(visible(result, 200)))
        elif self.keep == "best":
            given = self.journal.best(student.folder)
            best: Result = given.result
            result = best
        minutes = None
        if given.committed is not None:
            minutes = (self.journal.reference - given.committed) // 60
        return GradedStudent(
            student,
            result,
            commit=given.commit,
            branch=package.branch,
            minutes=minutes,
            note=self.notes.get(student.folder, ""),
            fault=fault,
            late=package.late if self.journal.deadline else None,
        )

    def _course(
        self,
        everybody: Sequence[GradedStudent],
        runs: Mapping[str, list[Runs]],
        now: int,
    ) -> Course:
        kit = _runs_of_kit(self.day)
        alike = similar.like_the_kit(runs, kit, _runs_of_functions(self.day))
        alike += similar.similar_groups({f: r[0] for f, r in runs.items() if r})
        journal = self.journal
        odd = ""
        if journal.odd:
            path = shown(journal.path.absolute())
            odd = f"{path}: lines that are no result, left out: {journal.odd:,}"
        return Course(
            self.day,
            everybody,
            alike=alike,
            reference=journal.reference,
            deadline=journal.deadline,
            seed=journal.seed,
            graded_now=now,
            outdated=journal.outdated,
            odd=odd,
        )


def pull(students: Sequence[Student]) -> dict[str, str]:
    """Clone and update; return what to add to a student's error, by folder.

    Who cannot be updated is graded as they are.
    """
    done = _bar(len(students), "pulling", pull_all(students))
    return {one.folder: f"not pulled: {problem}" for one, problem in done if problem}


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


def _runs_of_kit(day: Day) -> Runs:
    """Return the runs of a day's solution and of the library's modules that hold it."""
    files = [day.source, *(file_of(f"robo47.{name}") for name in day.library)]
    texts = "\n".join(map(read_script, files))
    return similar.runs_of(texts.encode(), starter_of(day))


def _runs_of_functions(day: Day) -> list[Runs]:
    """Return the runs of each function of a day's solution."""
    functions = similar.functions_of(read_script(day.source))
    names = (name for task in day.tasks for name in task.functions)
    texts = (functions.get(name, "") for name in names)
    starter = starter_of(day)
    return [similar.runs_of(text.encode(), starter) for text in texts]


def _hidden(package: Package, day: Day, result: Result) -> list[str]:
    """Return what passes and cannot be seen in a submission."""
    kits = day.source.with_name("kit.py").read_bytes()
    own = [data for data in package.modules().values() if data != kits]
    passed = {mark.id for mark in result.tasks if mark.passed}
    tasks = [task for task in day.tasks if task.id in passed]
    was = {now: was for task in tasks for was, now in task.renamed}
    names = [(f, was.get(f, f)) for task in tasks for f in task.functions]
    texts = [data.decode("utf-8", "replace") for data in own]
    return similar.hidden(texts, names, starter_of(day))


def _runs(package: Package, day: Day, starter: str) -> list[Runs]:
    """Return what `similar` compares of each file, the script's first."""
    files = package.modules()
    names = sorted(files, key=lambda name: name != day.script)
    return [similar.runs_of(files[name], starter) for name in names]


def _bar(total: int, doing: str, some: Iterable[Any] | None = None) -> "tqdm[Any]":
    how: dict[str, Any] = {"unit": "student", "leave": False, "delay": 1}
    return tqdm(some, total=total, desc=doing, disable=None, **how)
