"""A student's files, read without trusting the folder: it may be a stranger's.

Links are not followed, only regular files are read, and none beyond its limit.
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
NO_NAME = (errno.ENAMETOOLONG, errno.EINVAL, errno.ELOOP)  # of a file, on this system


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
    size = size_of(root, name)
    if size is None:
        return None
    if size > limit:
        most = f"{limit // MB} MB" if limit >= MB else f"{limit // 1000} kB"
        raise UnreadError(f"has {size / MB:,.1f} MB; at most {most} is looked at")
    try:
        with root.joinpath(name).open("rb") as file:
            return file.read(limit)
    except PermissionError as error:
        raise UnreadError(f"cannot be read: {error.strerror}") from None


def size_of(root: Path, name: str) -> int | None:
    """Return how many bytes a file has, or None where there is no such file.

    Arguments and errors are those of `read`.
    """
    path = root
    try:
        for part in name.split("/"):
            path /= part
            status = path.lstat()
            if stat.S_ISLNK(status.st_mode):
                raise UnreadError("is behind a link; hand in the file itself")
    except PermissionError as error:
        raise UnreadError(f"cannot be read: {error.strerror}") from None
    except (FileNotFoundError, NotADirectoryError, ValueError):  # ValueError: a NUL
        return None
    except OSError as error:
        if error.errno in NO_NAME:
            return None
        raise
    if not stat.S_ISREG(status.st_mode):
        raise UnreadError("is no file")
    return status.st_size


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
