"""Which files of a clone the student writes: one list, from the manifests."""

from fnmatch import fnmatchcase
from pathlib import Path

from labkit.lesson.day import all_days
from labkit.lesson.week import WORK, weeks
from robo47.paths import ROOT

LOG = "metrics/metrics.csv"


def is_students(name: str) -> bool:
    """Return whether the student writes a file.

    These are the log, every deliverable of a day, the retrospectives of a week, and
    everything in a week's `work/`, which holds the labs and the notebooks.

    Args:
        name: relative to the clone, with forward slashes.
    """
    return name == LOG or name in deliverables() or _is_of_a_week(name)


def deliverables() -> set[str]:
    """Return the names of the files that the days ask for."""
    return {name for day in all_days() for name in day.files.values()}


def work_links() -> list[str]:
    """Return the names of the `work/` folders that are symbolic links."""
    folders = (week.folder / WORK for week in weeks())
    return [_name(one) for one in folders if one.is_symlink()]


def _is_of_a_week(name: str) -> bool:
    for week in weeks():
        place, _, rest = name.partition("/")
        if place == week.folder.name:
            patterns = (f"{WORK}/*", *week.retrospectives)
            return any(fnmatchcase(rest, pattern) for pattern in patterns)
    return False


def _name(path: Path) -> str:
    return path.relative_to(ROOT).as_posix()
