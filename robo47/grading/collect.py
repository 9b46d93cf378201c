"""From a student's clone to a package: the few files that a grade depends on.

A clone is a stranger's. Links are not followed, only regular files are read, and none
beyond its limit: a file of 300 MB costs a look at its size.
"""

import contextlib
import itertools
import os
import posixpath
import stat
from pathlib import Path

from robo47.checker.deliverables import Item
from robo47.checker.deliverables.commit import (
    as_item,
    no_repository,
    wanted_files,
)
from robo47.checker.deliverables.worksheet import image_names
from robo47.grading import kit
from robo47.grading.history import History, read_history
from robo47.grading.package import Package
from robo47.grading.roster import Student
from robo47.lesson.day import Day

MB = 1_000_000
SCRIPT, FIGURE, WORKSHEET, METRICS = 1 * MB, 8 * MB, 2 * MB, 4 * MB  # bytes
HELPERS, IMAGES = 50, 40  # files beside the script; pictures of the worksheet
LINE = 300  # characters of a line with a picture
LISTED = 10_000  # entries of work/ that are looked at


class UnreadError(Exception):
    """A file is there but not for reading; its text completes "FILE ..."."""


def collect(student: Student, day: Day) -> Package:
    """Return what a student hands in.

    Args:
        student: from the roster.
        day: from the kit's manifest.
    """
    problem = student.problem
    if not problem and not student.path.is_dir():
        problem = "there is no such folder"
    if problem:
        return Package(day.number, kit.fingerprint(), problem=problem)
    clone, wanted = student.path, wanted_files(day)
    files, unread = _read_wanted(clone, wanted)
    history = read_history(clone, wanted)
    item = _commit_item(day, history, files, unread)
    files |= _helpers(clone, f"{day.folder.name}/work")
    files |= _pictures(clone, day, files)
    facts = (item, history.commit, history.committed)
    return Package(day.number, kit.fingerprint(), files, unread, *facts)


def _read_wanted(
    clone: Path, wanted: list[str]
) -> tuple[dict[str, bytes], dict[str, str]]:
    """Return the day's files, and why some that are there were not read."""
    files: dict[str, bytes] = {}
    unread: dict[str, str] = {}
    for name, limit in zip(wanted, (SCRIPT, WORKSHEET, FIGURE, METRICS), strict=True):
        try:
            data = read(clone, name, limit)
        except UnreadError as error:
            unread[name] = str(error)
        else:
            files |= {} if data is None else {name: data}
    return files, unread


def _commit_item(
    day: Day, history: History, files: dict[str, bytes], unread: dict[str, str]
) -> Item:
    """Return how the commit stands, in the checker's words."""
    if not history.readable:
        return no_repository()
    left = [
        name
        for name in wanted_files(day)
        if not (name in files or name in unread)
        or not history.holds(name, files.get(name))
    ]
    return as_item(day, left)


def read(clone: Path, name: str, limit: int) -> bytes | None:
    """Return a file's content, or None where there is no such file.

    Args:
        clone: the student's folder.
        name: path from there, with "/" as separator.
        limit: bytes.

    Raises:
        UnreadError: it is a link, no regular file, too large, or not for us.
    """
    size = _size(clone, name)
    if size is None:
        return None
    if size > limit:
        raise UnreadError(
            f"has {size / MB:,.1f} MB; at most {limit // MB} MB is looked at"
        )
    try:
        with clone.joinpath(name).open("rb") as file:
            return file.read(limit)
    except OSError as error:
        raise UnreadError(f"cannot be read: {error.strerror}") from None


def _size(clone: Path, name: str) -> int | None:
    """Return a regular file's bytes, or None where there is no such file.

    Raises:
        UnreadError: it is behind a link, or no regular file.
    """
    path = clone
    try:
        for part in name.split("/"):
            path /= part
            status = path.lstat()
            if stat.S_ISLNK(status.st_mode):
                raise UnreadError("is behind a link; hand in the file itself")
    except (FileNotFoundError, NotADirectoryError, ValueError):  # ValueError: a NUL
        return None
    except OSError as error:
        raise UnreadError(f"cannot be read: {error.strerror}") from None
    if not stat.S_ISREG(status.st_mode):
        raise UnreadError("is no file")
    return status.st_size


def _helpers(clone: Path, work: str) -> dict[str, bytes]:
    """Return the student's own modules beside the script, which it may import."""
    found: dict[str, bytes] = {}
    try:
        if (clone / work).is_symlink() or (clone / work).parent.is_symlink():
            return {}
        with os.scandir(clone / work) as entries:
            names = sorted(entry.name for entry in itertools.islice(entries, LISTED))
    except OSError:
        return {}
    modules = [n for n in names if n.endswith(".py") and n[:-3].isidentifier()]
    for name in modules[:HELPERS]:
        try:
            data = read(clone, f"{work}/{name}", SCRIPT)
        except UnreadError:
            continue
        if data is not None and sum(map(len, found.values())) + len(data) <= 2 * SCRIPT:
            found[f"{work}/{name}"] = data
    return found


def _pictures(clone: Path, day: Day, files: dict[str, bytes]) -> dict[str, bytes]:
    """Return the worksheet's pictures: one byte says that it is there.

    What may be one of the kit's own, by its size, is returned whole.
    """
    worksheet = wanted_files(day)[1]
    kits = [day.folder / name for name in day.kit_figures]
    sizes = {path.stat().st_size for path in kits if path.is_file()}
    text = files.get(worksheet, b"").decode("utf-8", "replace")
    # line by line, and no long ones: a search must not take longer than the file merits
    lines = [line for line in text.splitlines() if len(line) <= LINE]
    names = [name for line in lines for name in image_names(line)]
    found: dict[str, bytes] = {}
    for name in names[:IMAGES]:
        address = name.replace("%20", " ")
        path = posixpath.normpath(posixpath.join(posixpath.dirname(worksheet), address))
        if path.startswith(("/", "../")) or path in files:
            continue
        with contextlib.suppress(UnreadError):
            if size := _size(clone, path):
                whole = size in sizes and read(clone, path, FIGURE)
                found[path] = whole or b"x"
    return found
