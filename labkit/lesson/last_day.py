"""The day that a student worked on last: by their edits and starts, not by its number.

A lab that was saved counts by the time of its file; `make start DAY=5` counts too,
where the file is there already. A fresh clone has files of one moment: then the
highest number is meant.
"""

import time
from pathlib import Path

from labkit.base import store
from labkit.lesson.week import WORK, manifests
from robo47.paths import ROOT

MEMORY = "last_day.json"
ONE_MOMENT = 2.0  # seconds: git writes the files of a checkout within it


def remember(number: int, root: Path = ROOT) -> None:
    """Remember that a day was started or named now.

    Args:
        number: of the day.
        root: the clone.
    """
    store.write(MEMORY, {"day": number, "time": time.time()}, root)


def started_day(root: Path = ROOT) -> int:
    """Return the day worked on last; without one the first day of the course.

    Args:
        root: the clone.
    """
    there = manifests(root)
    saved = {n: _saved(path.parents[1], n) for n, path in there.items()}
    begun = {n: moment for n, moment in saved.items() if moment > 0}
    if not begun:
        return min(there, default=1)
    newest = max(begun.values())
    named = store.read(MEMORY, root)
    when = named.get("time")
    if named.get("day") in begun and isinstance(when, int | float) and when >= newest:
        return int(named["day"])
    return max(n for n, moment in begun.items() if moment > newest - ONE_MOMENT)


def _saved(week: Path, number: int) -> float:
    """Return when a day's lab was saved, seconds since 1970; 0 where there is none."""
    labs = week.glob(f"{WORK}/day{number}_*.py")
    return max((lab.stat().st_mtime for lab in labs if lab.is_file()), default=0.0)
