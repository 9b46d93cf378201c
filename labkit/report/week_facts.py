"""Facts of a week, read from what is on the student's own machine.

Hints and mistakes come from `.robo47/`, which git ignores: they are for the student's
eyes and nobody else's.
"""

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from labkit.base.git import GitError, run
from labkit.check import journal, own_functions
from labkit.check.journal import Met
from labkit.handin.handin import day_files
from labkit.lesson.day import Day
from labkit.report.series import Series
from labkit.report.thresholds import Key
from labkit.report.week_numbers import Number, numbers_of
from robo47.paths import ROOT

GIT_SECONDS = 10.0


@dataclass(frozen=True)
class DayFacts:
    """How a day went.

    Attributes:
        day: from the manifest.
        numbers: the student's beside the kit's.
        passed: how many tasks pass; side quests are not counted.
        tasks: of how many.
        own: how many of the day's functions the capstone takes from the student.
        functions: of how many.
        minutes: from the first to the last commit, None where git cannot tell.
        hints: how many were asked for.
        met: the named mistakes, in the order they were met.
    """

    day: Day
    numbers: Sequence[Number]
    passed: int
    tasks: int
    own: int
    functions: int
    minutes: int | None
    hints: int
    met: Sequence[Met]

    @property
    def begun(self) -> bool:
        """Whether the student has a file of the day."""
        return self.day.work.is_file()


def facts_of(day: Day, series: Mapping[Key, Series], root: Path = ROOT) -> DayFacts:
    """Return how a day went; a file that changed since is checked in the sandbox.

    Args:
        day: from its manifest.
        series: the log's rows, by day, check and metric.
        root: the clone.
    """
    statuses = own_functions.statuses(day)
    counted = [task.id for task in day.tasks if not task.optional]
    own = own_functions.load([day])
    ids = {task.id for task in day.tasks}
    return DayFacts(
        day,
        numbers_of(day, series),
        sum(statuses[id] == "passed" for id in counted),
        len(counted),
        len(own.yours),
        own.total,
        minutes_of(day, root),
        sum(n for task, n in hints_given(root).items() if task in ids),
        [m for m in journal.mistakes_met(journal.read(root)) if m.task in ids],
    )


def minutes_of(day: Day, root: Path = ROOT) -> int | None:
    """Return the minutes from the first to the last commit of what a day hands in.

    Args:
        day: from its manifest.
        root: the clone.

    Returns:
        None where there are no two commits, or no git.
    """
    files = day_files(day)
    own = [files[name] for name in ("script", "figure") if name in files]
    begun = _times(root, own)
    if not begun:
        return None
    times = list(begun)
    if "worksheet" in files:  # its first commits are the kit's own
        times += [t for t in _times(root, [files["worksheet"]]) if t > min(begun)]
    return round((max(times) - min(times)) / 60) if len(times) > 1 else None


def hints_given(root: Path = ROOT) -> dict[str, int]:
    """Return how many hints were asked for, by task."""
    try:
        seen = json.loads((root / ".robo47" / "hints.json").read_text("utf-8"))
        return {str(task): int(count) for task, count in seen.items()}
    except (OSError, ValueError, TypeError, AttributeError):
        return {}


def _times(root: Path, paths: Sequence[str]) -> list[int]:
    """Return when files were committed, seconds since 1970."""
    try:
        done = run(
            "log", "--format=%ct", "--", *paths, folder=root, seconds=GIT_SECONDS
        )
    except GitError:
        return []
    return [int(word) for word in done.stdout.split() if word.isdecimal()]
