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
from labkit.check.memory import Met
from labkit.lesson.day import Day, Metric
from labkit.lesson.marks import mark_of, writers_of
from labkit.report.series import Key, Series, float_of
from robo47.paths import ROOT

GIT_SECONDS = 10.0


@dataclass(frozen=True)
class Number:
    """One number of a day; None where there is no row."""

    metric: Metric  # what it must reach
    latest: float | None  # the student's last run
    status: str  # what that run is worth now, as `Writers.judge` says
    worst: float | None  # the farthest from the limit's good side that they logged
    kit: float | None  # the kit's own last run on this machine

    @property
    def passed(self) -> bool:
        """Whether the student's file as it is gave a number within the limit."""
        return self.status == "pass"


@dataclass(frozen=True)
class DayFacts:
    """How a day went."""

    day: Day
    numbers: Sequence[Number]  # the student's beside the kit's
    passed: int  # how many tasks pass; side quests are not counted
    tasks: int  # of how many
    own: int  # how many of the day's functions are in tasks that pass
    functions: int  # of how many
    minutes: int | None  # from the first to the last commit; None: git cannot tell
    hints: int  # how many were asked for
    met: Sequence[Met]  # the named mistakes, in the order they were met
    # Whether `make check` has seen all tasks in the file as it is; else none passed.
    checked: bool = True
    borrowed: Sequence[str] = ()  # tasks whose functions are borrowed from the kit

    @property
    def begun(self) -> bool:
        """Whether the student has a file of the day."""
        return self.day.work.is_file()


def facts_of(day: Day, series: Mapping[Key, Series], root: Path = ROOT) -> DayFacts:
    """Return how a day went.

    Args:
        day: from its manifest.
        series: the log's rows, by day, check and metric.
        root: the clone.
    """
    known = memory.known(day)
    passed = [task for task in day.tasks if known.get(task.id) == "passed"]
    ids = {task.id for task in day.tasks}
    return DayFacts(
        day,
        numbers_of(day, series),
        sum(not task.optional for task in passed),
        sum(not task.optional for task in day.tasks),
        sum(len(task.functions) for task in passed),
        sum(len(task.functions) for task in day.tasks),
        minutes_of(day, root),
        sum(n for task, n in store.hints_given(root).items() if task in ids),
        [m for m in memory.mistakes_met(memory.journal(root), known) if m.task in ids],
        len(known) == len(ids),
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
    own = [files[name] for name in ("script", "figure") if name in files]
    begun = _times(root, own)
    if not begun:
        return None
    times = list(begun)
    if "worksheet" in files:  # its first commits are the kit's own
        times += [t for t in _times(root, [files["worksheet"]]) if t > min(begun)]
    return round((max(times) - min(times)) / 60) if len(times) > 1 else None


def _times(root: Path, paths: Sequence[str]) -> list[int]:
    """Return when files were committed, seconds since 1970."""
    try:
        done = run(
            "log", "--format=%ct", "--", *paths, folder=root, seconds=GIT_SECONDS
        )
    except GitError:
        return []
    return [int(word) for word in done.stdout.split() if word.isdecimal()]


def numbers_of(day: Day, series: Mapping[Key, Series]) -> list[Number]:
    """Return a day's numbers, in the manifest's order.

    Args:
        day: from its manifest.
        series: the log's rows, by day, check and metric.
    """
    found = []
    for metric in day.metrics:
        key = (day.number, metric.check, metric.metric)
        found.append(_number(metric, series.get(key) or Series(key, metric)))
    return found


def _number(metric: Metric, series: Series) -> Number:
    mine = [row for row in series.rows if mark_of(row)]
    own = [float_of(row) for row in mine]
    return Number(
        metric,
        own[-1] if own else None,
        series.writers.judge(metric, mine[-1] if mine else None),
        max(own, key=lambda value: _badness(metric, value), default=None),
        float_of(series.kits[-1]) if series.kits else None,
    )


def _badness(metric: Metric, value: float) -> float:
    """Return what grows as a value gets worse; a value that is no number is worst."""
    if value != value:
        return float("inf")
    return -value if metric.max is None else value
