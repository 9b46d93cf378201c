"""A student's files, read without trusting the folder: it may be a stranger's.

Links are not followed, also not those that take a file's place meanwhile, only regular
files are read, and none beyond its limit.
"""

import errno
import itertools
import os
import posixpath
import re
import stat
from pathlib import Path

MB = 1_000_000
# Bytes of a student's file, ten times as many as the longest lab has: to compile a
# megabyte of functions of one name takes half a minute.
SCRIPT = 100_000
HELPERS = 50  # modules beside the script
LISTED = 10_000  # entries of work/ that are looked at
# No file of this system can have such a name.
NO_NAME = (errno.ENAMETOOLONG, errno.EINVAL, errno.ELOOP)

BEHIND_A_LINK = "is behind a link; hand in the file itself"
_FROM_FOLDERS = os.open in os.supports_dir_fd
_NO_LINK = getattr(os, "O_NOFOLLOW", 0)
_FOLDER = getattr(os, "O_DIRECTORY", 0) | getattr(os, "O_PATH", os.O_RDONLY)
_FILE = os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0)


class UnreadError(Exception):
    """A file is there but not for reading; its text completes "FILE ..."."""


def read(root: Path, name: str, limit: int) -> bytes | None:
    """Return a file's content, or None where there is no such file.

    Args:
        root: the student's folder.
        name: path from there, with "/" as separator.
        limit: bytes.

    Raises:
        UnreadError: it is a link, no regular file, too large, or not for us.
        OSError: the machine's own trouble.
    """
    opened = _open(root, name)
    if opened is None:
        return None
    with open(opened, "rb") as file:
        size = _size(opened)
        if size > limit:
            most = f"{limit // MB} MB" if limit >= MB else f"{limit // 1000} kB"
            raise UnreadError(f"has {size / MB:,.1f} MB; at most {most} is looked at")
        return file.read(limit)


def size_of(root: Path, name: str) -> int | None:
    """Return how many bytes a file has, or None where there is no such file.

    Arguments and errors are those of `read`.
    """
    opened = _open(root, name)
    if opened is None:
        return None
    with open(opened, "rb"):
        return _size(opened)


def _size(opened: int) -> int:
    status = os.fstat(opened)  # the file may have been replaced after it was opened
    if not stat.S_ISREG(status.st_mode):
        raise UnreadError("is no file")
    return status.st_size


def _open(root: Path, name: str) -> int | None:
    """Return a descriptor of a file, or None where there is no such file.

    Each part of the path is opened from the one before, so one that is swapped for a
    link meanwhile leads nowhere. (Windows opens nothing from a folder.)
    """
    *folders, last = name.split("/")
    if ".." in folders:
        return None
    path, at = str(root), None
    try:
        at = os.open(path, _FOLDER) if _FROM_FOLDERS else None
        for part in (*folders, last):
            path = part if _FROM_FOLDERS else os.path.join(path, part)
            status = os.stat(path, dir_fd=at, follow_symlinks=False)
            if stat.S_ISLNK(status.st_mode):
                raise UnreadError(BEHIND_A_LINK)
            if _FROM_FOLDERS and part is not last:
                at, before = os.open(path, _FOLDER | _NO_LINK, dir_fd=at), at
                os.close(before)  # type: ignore[arg-type]
        if not stat.S_ISREG(status.st_mode):  # a pipe or a device is not even opened
            raise UnreadError("is no file")
        return os.open(path, _FILE | _NO_LINK, dir_fd=at)
    except PermissionError as error:
        raise UnreadError(f"cannot be read: {error.strerror}") from None
    except (FileNotFoundError, NotADirectoryError, ValueError):  # ValueError: a NUL
        return None
    except OSError as error:
        if error.errno == errno.ELOOP:  # it was none a moment ago
            raise UnreadError(BEHIND_A_LINK) from None
        if error.errno in NO_NAME:
            return None
        raise
    finally:
        if at is not None:
            os.close(at)


def helpers_of(root: Path, script: str, source: bytes) -> dict[str, bytes]:
    """Return the student's own modules that a script needs, however indirectly.

    Args:
        root: the student's folder.
        script: its path from there.
        source: its content.
    """
    work = posixpath.dirname(script)
    try:
        if (root / work).is_symlink() or (root / work).parent.is_symlink():
            return {}
        with os.scandir(root / work) as entries:
            names = [entry.name for entry in itertools.islice(entries, LISTED)]
    except (FileNotFoundError, NotADirectoryError, PermissionError):
        return {}
    modules = (name[:-3] for name in names if name.endswith(".py"))
    there = set(filter(str.isidentifier, modules))
    found: dict[str, bytes] = {}
    waiting = [source]
    while waiting:
        for name in sorted(_imported(waiting.pop()) & there):
            path = f"{work}/{name}.py"
            if path in found or path == script or len(found) == HELPERS:
                continue
            try:
                data = read(root, path, SCRIPT) or b""
            except UnreadError:
                continue
            if sum(map(len, found.values())) + len(data) <= 2 * SCRIPT:
                found[path] = data
                waiting.append(data)
    return found


def _imported(source: bytes) -> set[str]:
    """Return every word of a file that may name a module it imports."""
    text = source.decode("utf-8", "replace")
    lines = [
        ln for ln in text.splitlines() if re.match(r"[^#\n]*\b(import|from)\b", ln)
    ]
    return set(re.findall(r"\w+", "\n".join(lines)))
