"""The work that counts: the folder as it is, or its last commit before the deadline."""

import errno
import os
import tempfile
from pathlib import Path

from labkit.base.git import History, before, blob, files_of, read_history
from labkit.handin.deliverables import wanted_names
from labkit.handin.handin import (
    LIMITS,
    PICTURES,
    Handin,
    image_names,
    picture_path,
    read_handin,
)
from labkit.lesson.day import Day
from labkit.lesson.own_files import HELPERS, NO_NAME

FOLDER = "robo47-commit-"
LARGEST = max(LIMITS.values())  # bytes of a file that is looked at
MOST = 4 * HELPERS  # files beside the script: one blob may have any number of names


def read_in_time(
    day: Day, clone: Path, deadline: int | None
) -> tuple[Handin, History, int]:
    """Return what a student hands in, its commit, and how many commits came too late.

    Where the last commit is late, the last one that is not counts; where all are late,
    the last one. Uncommitted work counts as long as no commit is late.

    Args:
        day: from the kit's manifest.
        clone: the student's folder.
        deadline: seconds since 1970, or None.

    Raises:
        OSError, GitError: this machine failed.
    """
    handin = read_handin(_as_there(day, clone), clone)
    history = read_history(clone, wanted_names(day, handin))
    is_late = history.committed is None or history.committed > (deadline or 0)
    if deadline is None or not history.commit or not is_late:
        return handin, history, 0
    commit, late = before(clone, deadline)
    if not commit:
        return handin, history, late
    with tempfile.TemporaryDirectory(prefix=FOLDER) as folder:
        _check_out(day, clone, commit, Path(folder))
        handin = read_handin(_as_there(day, Path(folder)), Path(folder))
    return handin, read_history(clone, wanted_names(day, handin), at=commit), late


def _as_there(day: Day, root: Path) -> Day:
    return day.named_as(lambda name: os.path.isfile(root / name))


def _check_out(day: Day, clone: Path, commit: str, folder: Path) -> None:
    """Write what a day may hand in of a commit, without running anything of git's."""
    work = f"{Path(day.files['script']).parent.as_posix()}/"
    _write(clone, files_of(clone, commit, *day.files.values()), folder)
    beside = files_of(clone, commit, work).items()
    helpers = {name: facts for name, facts in beside if name.endswith(".py")}
    _write(clone, helpers, folder, LIMITS["script"])
    sheet = day.files.get("worksheet", "")
    there = sheet and (folder / sheet).is_file()
    text = (folder / sheet).read_text("utf-8", "replace") if there else ""
    names = [picture_path(one, sheet) for one in image_names(text)[:PICTURES]]
    _write(clone, files_of(clone, commit, *filter(None, names)), folder)


def _write(
    clone: Path,
    files: dict[str, tuple[str, int]],
    folder: Path,
    largest: int = LARGEST,
) -> None:
    for name, (hash_, size) in list(files.items())[:MOST]:
        path = folder / name
        try:
            if path.exists() or ".." in path.parts:
                continue
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(b"" if size > largest else blob(clone, hash_))
        except OSError as error:
            if error.errno in (*NO_NAME, errno.EEXIST, errno.ENOTDIR):
                continue  # git knows names that no folder has
            raise
        if size > largest:  # its size is all that is looked at
            os.truncate(path, size)
