"""The files of a clone that the student writes: one list, from the manifests.

Hand-in, update, fresh, edition, report and capstone ask this module; no other one has
a pattern of these names.
"""

from fnmatch import fnmatchcase
from pathlib import Path

from labkit.lesson.day import LOG, all_days
from labkit.lesson.week import NOTEBOOKS, WORK, Week, weeks
from robo47.paths import ROOT

# The kit has no files in these folders of a week.
MADE = (f"{WORK}/*", f"{NOTEBOOKS}/*")
OWN_LABS = f"w*/{WORK}/**"  # a pattern of paths in git's form


def is_students(name: str) -> bool:
    """Return whether the student writes a file.

    These are the log, every deliverable of a day, the retrospectives of a week, and
    everything in a week's folders of labs and of notebooks.

    Args:
        name: relative to the clone, with forward slashes.
    """
    filled_in = name == LOG or name in deliverables()
    return filled_in or is_made(name) or _is_of_a_week(name, retrospectives=True)


def is_made(name: str) -> bool:
    """Return whether a student's file begins without a template of the kit's.

    These are the labs, the notebooks and the figures.

    Args:
        name: relative to the clone, with forward slashes.
    """
    return name in figures() or _is_of_a_week(name)


def deliverables() -> set[str]:
    """Return the names of the files that the days ask for."""
    return {name for day in all_days() for name in day.files.values()}


def figures() -> set[str]:
    """Return the names of the figures that the days ask for."""
    return {day.files["figure"] for day in all_days() if day.figure}


def retrospectives(week: Week, root: Path | None = None) -> list[Path]:
    """Return a week's retrospectives that are there, sorted.

    Args:
        week: from its manifest.
        root: the clone to search; None is the one that the manifest is in.
    """
    folder = root / week.folder.name if root else week.folder
    return sorted(path for one in week.retrospectives for path in folder.glob(one))


def work_links() -> list[str]:
    """Return the names of the `work/` folders that are symbolic links."""
    folders = (week.folder / WORK for week in weeks())
    return [_name(one) for one in folders if one.is_symlink()]


def _is_of_a_week(name: str, *, retrospectives: bool = False) -> bool:
    for week in weeks():
        place, _, rest = name.partition("/")
        if place == week.folder.name:
            patterns = (*MADE, *week.retrospectives) if retrospectives else MADE
            return any(fnmatchcase(rest, pattern) for pattern in patterns)
    return False


def _name(path: Path) -> str:
    return path.relative_to(ROOT).as_posix()
