"""Facts of a proof: a clone's tasks and numbers, found now and in the sandbox."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from labkit.base.git import History, read_history
from labkit.base.text import visible
from labkit.check.lab_run import rehearse
from labkit.check.memory import in_words
from labkit.check.tasks import check_tasks
from labkit.grade.package import collect, unpack
from labkit.grade.roster import Student
from labkit.handin.deliverables import check_commit, wanted_names
from labkit.handin.handin import Handin
from labkit.handin.rows import rows_of
from labkit.lesson.day import Day
from labkit.lesson.script import writers_of
from labkit.report.series import Series, series_of
from labkit.report.week_facts import DayFacts
from labkit.sandbox.sandbox import Sandbox
from robo47.errors import Robo47Error

CALLS = 20_000  # of a lab's functions: all of the kit's labs need fewer


@dataclass(frozen=True)
class RunDay(DayFacts):
    """How a day of somebody's stands, as it ran here."""

    # The numbers that the lab gave with theirs as far as it came, by check and metric.
    again: Mapping[tuple[str, str], float] = field(default_factory=dict)
    fault: str = ""  # the first step of the lab that failed here, "" where none did
    # What the commit lacks of what is in the folder; "" where it has all.
    left: str = ""


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


def facts_of(day: Day, clone: Clone, folder: Path, sandbox: Sandbox) -> RunDay:
    """Return how a day stands; its files are left in an empty folder for the capstone.

    Raises:
        OSError, GitError, FaultError: this machine failed.
    """
    package = collect(clone.student, day)
    unpack(package, folder)
    script = package.handin.files.get(day.files["script"])
    if script is None:
        states = {task.id: "not begun" for task in day.tasks}
        return RunDay(day, states, _numbers(day, package.handin))
    results = check_tasks(day, folder / day.script, sandbox)
    done = all(r.passed for r in results if not r.task.optional)
    fault, again = "", dict[tuple[str, str], float]()
    if done:
        fault, again = rehearse(day, folder / day.script, sandbox, CALLS)
    item = package.commit_item
    if clone.own:  # git may be asked for more of one's own
        wanted = wanted_names(day, package.handin)
        history = read_history(clone.student.path, wanted, own=True)
        item = check_commit(day, package.handin, history)
    return RunDay(
        day,
        {result.task.id: in_words(result.verdict) for result in results},
        _numbers(day, package.handin),
        again,
        visible(fault, 300),
        "" if item.passed else visible(item.message.partition("\n")[0], 300),
    )


def _numbers(day: Day, handin: Handin) -> list[Series]:
    """Return the runs of a day's numbers that are in the log."""
    writers = writers_of(day, handin.files.get(day.files["script"], b""))
    try:
        return series_of(day, rows_of(day, handin), writers)
    except Robo47Error:  # no log that can be read
        return series_of(day, [], writers)
