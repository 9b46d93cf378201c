"""Facts of a week, read from what is on the student's own machine.

Hints and mistakes come from `.robo47/`, which git ignores: they are for the student's
eyes and nobody else's. The student's own rows of the log and the kit's are told apart
by the mark in their notes.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from labkit.base import store
from labkit.base.git import GitError, run
from labkit.check import memory
from labkit.check.memory import MetMistake
from labkit.lesson.day import Day
from labkit.lesson.writers import writers_of
from labkit.report.series import Series
from robo47.paths import ROOT

GIT_SECONDS = 10.0


@dataclass(frozen=True)
class DayFacts:
    """The state of a day."""

    day: Day
    # How each task stands, "passed", "wrong" and so on; none that nobody checked as
    # the file is now.
    states: Mapping[str, str]
    numbers: Sequence[Series]  # the order is the manifest's

    @property
    def own(self) -> list[str]:
        """The functions that are the student's and right."""
        return memory.passing(self.day, self.states)

    @property
    def functions(self) -> int:
        """The number of functions that the day asks for."""
        return sum(len(task.functions) for task in self.day.tasks)


@dataclass(frozen=True)
class OwnDay(DayFacts):
    """The history of a student's day."""

    # minutes from the first to the last commit, as git knows
    minutes: int | None = None
    hints: int = 0  # the number of hints that were asked for
    met: Sequence[MetMistake] = ()  # the named mistakes, in the order they were met
    borrowed: Sequence[str] = ()  # tasks whose functions are borrowed from the kit

    @property
    def checked(self) -> bool:
        """`make check` has seen all tasks in the present file."""
        return len(self.states) == len(self.day.tasks)

    @property
    def graded(self) -> list[bool]:
        """For each task whether it passes, without side quests."""
        tasks = [task for task in self.day.tasks if not task.optional]
        return [self.states.get(task.id) == "passed" for task in tasks]


def facts_of(day: Day, series: Sequence[Series]) -> OwnDay:
    """Return how a day went.

    Args:
        day: from its manifest.
        series: the log's rows of all that the day asks for.
    """
    known = memory.task_states(day)
    ids = {task.id for task in day.tasks}
    by = {one.wanted: one for one in series if one.day == day.number}
    return OwnDay(
        day,
        known,
        [by[metric].signed() for metric in day.metrics],
        minutes_of(day),
        sum(n for task, n in store.hints_given().items() if task in ids),
        [m for m in memory.mistakes_met(memory.journal(), known) if m.task in ids],
        writers_of(day).borrowed,
    )


def minutes_of(day: Day, root: Path = ROOT) -> int | None:
    """Return the minutes from the first to the last commit of what a day hands in.

    Args:
        day: from its manifest.
        root: the clone.

    Returns:
        None where there are no two commits, or no git.
    """
    files = day.files
    times = _times(root, *[files[it] for it in ("script", "figure") if it in files])
    if times and "worksheet" in files:
        begun = min(times)  # the worksheet's first commits are the kit's own
        times += [t for t in _times(root, files["worksheet"]) if t > begun]
    return round((max(times) - min(times)) / 60) if len(times) > 1 else None


def _times(root: Path, *paths: str) -> list[int]:
    """Return when files were committed, seconds since 1970."""
    log = ("log", "--format=%ct", "--", *paths)
    try:
        done = run(*log, folder=root, seconds=GIT_SECONDS)
    except GitError:
        return []
    return [int(word) for word in done.stdout.split() if word.isdecimal()]
