"""Facts of a proof: a clone's tasks and numbers, found now and in the sandbox."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from labkit.base.git import History, read_history
from labkit.base.text import visible
from labkit.check.lab_run import rehearse
from labkit.check.memory import in_words
from labkit.check.tasks import check_tasks
from labkit.grade.package import Package, collect, unpack
from labkit.grade.roster import Student
from labkit.handin.commit import check_commit, wanted_names
from labkit.handin.rows import rows_of
from labkit.lesson.day import Day, Metric
from labkit.lesson.marks import mark_of, writers_with
from labkit.log.rows import Row
from labkit.report.series import value_of
from labkit.sandbox.sandbox import Sandbox
from robo47.errors import Robo47Error

CALLS = 20_000  # of a lab's functions: all of the kit's labs need fewer


@dataclass(frozen=True)
class Number:
    """One number of a day."""

    metric: Metric  # what it must reach
    logged: float | None  # the last row that is not the kit's; None without one
    worth: str  # what that row is worth now, as `Writers.judge` says
    # What the lab gave here with theirs; None where it did not come so far.
    again: float | None


@dataclass(frozen=True)
class DayFacts:
    """How a day stands."""

    day: Day  # from the kit's manifest
    # How each function stands: "passed", "borrowed", "wrong", "to do", ...
    states: Mapping[str, str]
    numbers: Sequence[Number]  # in the manifest's order
    fault: str = ""  # the first step of the lab that failed here, "" where none did
    # What the commit lacks of what is in the folder; "" where it has all.
    left: str = ""

    @property
    def own(self) -> list[str]:
        """The functions that are the student's and right."""
        return [name for name, state in self.states.items() if state == "passed"]


@dataclass(frozen=True)
class Clone:
    """Somebody's clone."""

    student: Student  # name and folder
    own: bool = False  # it is the reader's own, which may be a linked worktree
    # Its last commit.
    history: History = field(default_factory=lambda: History(readable=False))

    @property
    def name(self) -> str:
        """The student's, as one harmless line."""
        name = self.student.name or self.history.author
        return visible(name, 80) or "somebody whom git does not know"


def open_clone(path: Path, name: str = "", *, own: bool = False) -> Clone:
    """Return a clone with its last commit.

    Args:
        path: its folder.
        name: the student's; by default the last commit's author.
        own: it is the reader's.

    Raises:
        GitError: git is not there, or takes too long.
    """
    student = Student(name, path.name, path)
    return Clone(student, own, read_history(path, (), own=own))


def facts_of(day: Day, clone: Clone, folder: Path, sandbox: Sandbox) -> DayFacts:
    """Return how a day stands; its files are left in an empty folder for the capstone.

    Raises:
        OSError, GitError, FaultError: this machine failed.
    """
    package = collect(clone.student, day)
    unpack(package, folder)
    script = package.handin.files.get(day.files["script"])
    if script is None:
        states = {f: "not begun" for task in day.tasks for f in task.functions}
        return DayFacts(day, states, _numbers(day, package, {}))
    results = check_tasks(day, folder / day.script, sandbox)
    done = all(r.passed for r in results if not r.task.optional)
    fault, again = "", dict[tuple[str, str], float]()
    if done:
        fault, again = rehearse(day, folder / day.script, sandbox, CALLS)
    return DayFacts(
        day,
        {f: in_words(r.verdict) for r in results for f in r.task.functions},
        _numbers(day, package, again),
        visible(fault, 300),
        _left(day, package, clone),
    )


def _left(day: Day, package: Package, clone: Clone) -> str:
    """Return what the last commit lacks of a day's files, in a line."""
    item = package.commit_item
    if clone.own:  # git may be asked for more of one's own
        wanted = wanted_names(day, package.handin)
        history = read_history(clone.student.path, wanted, own=True)
        item = check_commit(day, package.handin, history)
    return "" if item.passed else visible(item.message.partition("\n")[0], 300)


def _numbers(
    day: Day, package: Package, again: Mapping[tuple[str, str], float]
) -> list[Number]:
    """Return a day's numbers: those of the log, and those that the lab gave here."""
    handin = package.handin
    writers = writers_with(day, handin.files.get(day.files["script"]))
    try:
        rows = rows_of(day, handin)
    except Robo47Error:  # no log that can be read
        rows = []
    latest: dict[tuple[str, str], Row] = {
        (str(row["check"]), str(row["metric"])): row
        for row in rows
        if mark_of(row) not in writers.kits
    }
    found = []
    for metric in day.metrics:
        key = metric.check, metric.metric
        row = latest.get(key)
        value = None if row is None else value_of(row)
        worth = writers.judge(metric, row)
        found.append(Number(metric, value, worth, again.get(key)))
    return found
