"""A student's hand-in for a day: a few files as bytes, and names of pictures.

A folder may be a stranger's. Links are not followed, only regular files are read, and
none beyond its limit. What is handed in is the same for `make check` and for a grade.
"""

import errno
import itertools
import os
import posixpath
import re
import stat
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from urllib.parse import unquote

from labkit.base.exchange import SCRIPT
from labkit.lesson.day import Day

MB = 1_000_000
# In bytes.
LIMITS = {"script": SCRIPT, "worksheet": 200_000, "figure": 8 * MB, "log": 4 * MB}
HELPERS, PICTURES = 50, 40  # modules beside the script; pictures of the worksheet
LISTED = 10_000  # entries of work/ that are looked at
IMAGES = (".png", ".jpg", ".jpeg", ".gif", ".svg", ".webp", ".bmp", ".heic", ".tiff")

# Each search ends within a few hundred characters of where it began.
_IMAGE = re.compile(
    r"!\[[^\]\n]{0,300}+\]\([ \t]{0,9}+<?([^)>\s]{1,300}+)[^)\n]{0,300}+\)"
    r"|<img[^>\n]{1,300}?src=[\"']([^\"'\n]{1,300})"
)


NO_NAME = (errno.ENAMETOOLONG, errno.EINVAL, errno.ELOOP)  # of a file, on this system


class UnreadError(Exception):
    """A file is there but not for reading; its text completes "FILE ..."."""


@dataclass(frozen=True)
class Handin:
    """What a student hands in for a day, by path from the top, with "/" in it."""

    files: Mapping[str, bytes] = field(default_factory=dict)  # their content
    unread: Mapping[str, str] = field(default_factory=dict)  # why not, if it is there
    # The worksheet's that are there: whether it is the kit's own.
    pictures: Mapping[str, bool] = field(default_factory=dict)


def read_handin(day: Day, root: Path) -> Handin:
    """Return what a student hands in.

    Args:
        day: from the kit's manifest.
        root: the student's clone.

    Raises:
        OSError: this machine cannot read just now: not the student's doing.
    """
    files: dict[str, bytes] = {}
    unread: dict[str, str] = {}
    wanted = day.files
    for what, name in wanted.items():
        try:
            data = read(root, name, LIMITS[what])
        except UnreadError as error:
            unread[name] = str(error)
        else:
            files |= {} if data is None else {name: data}
    files |= helpers_of(root, wanted["script"], files)
    sheet = wanted.get("worksheet", "")
    text = files.get(sheet, b"").decode("utf-8", "replace")
    return Handin(files, unread, _pictures(day, root, sheet, text))


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
    size = _size(root, name)
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


def image_names(text: str) -> list[str]:
    """Return the addresses of the images in a Markdown text, as they stand there."""
    return [first or second for first, second in _IMAGE.findall(text)]


def picture_path(address: str, worksheet: str) -> str:
    """Return where in the clone a picture's address leads; "" where it leads nowhere.

    Args:
        address: as it stands in the worksheet; one of the web, of another drive, or
            above the clone is none.
        worksheet: its path from the top of the clone.
    """
    address = unquote(address)
    if re.search(r"[\\:\0-\x1f]", address) or address.startswith("/"):
        return ""
    path = posixpath.normpath(posixpath.join(posixpath.dirname(worksheet), address))
    inside = not path.startswith("../") and path.lower().endswith(IMAGES)
    return path if inside else ""


def _size(root: Path, name: str) -> int | None:
    """Return a regular file's bytes, or None where there is no such file."""
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


def helpers_of(root: Path, script: str, files: Mapping[str, bytes]) -> dict[str, bytes]:
    """Return the student's own modules that a script needs, however indirectly.

    Args:
        root: the student's folder.
        script: its path from there.
        files: its content, by that path.
    """
    work = posixpath.dirname(script)
    try:
        if (root / work).is_symlink() or (root / work).parent.is_symlink():
            return {}
        with os.scandir(root / work) as entries:
            names = [entry.name for entry in itertools.islice(entries, LISTED)]
    except (FileNotFoundError, NotADirectoryError, PermissionError):
        return {}
    modules = sorted(n[:-3] for n in names if n.endswith(".py"))
    there = {name for name in modules if name.isidentifier()}
    found: dict[str, bytes] = {}
    waiting = [files.get(script, b"")]
    while waiting:
        for name in sorted(_imported(waiting.pop()) & there):
            path = f"{work}/{name}.py"
            if path in found or path == script or len(found) == HELPERS:
                continue
            try:
                data = read(root, path, LIMITS["script"]) or b""
            except UnreadError:
                continue
            if sum(map(len, found.values())) + len(data) <= 2 * LIMITS["script"]:
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


def _pictures(day: Day, root: Path, sheet: str, text: str) -> dict[str, bool]:
    """Return the worksheet's pictures that are there: whether each is the kit's."""
    kits = [day.folder / name for name in day.kit_figures]
    sizes = {path.stat().st_size: path for path in kits if path.is_file()}
    own = {f"{day.folder.name}/{name}" for name in day.kit_figures}
    found: dict[str, bool] = {}
    for address in image_names(text)[:PICTURES]:
        path = picture_path(address, sheet)
        try:
            size = _size(root, path) if path else None
            kit = path in own
            if size in sizes and not kit:
                kit = read(root, path, LIMITS["figure"]) == sizes[size].read_bytes()
        except UnreadError:
            continue
        if size:
            found[path] = kit
    return found
