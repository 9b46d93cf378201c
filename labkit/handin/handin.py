"""A student's hand-in for a day: a few files as bytes, and names of pictures.

What is handed in is the same for `make check` and for a grade.
"""

import posixpath
import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from urllib.parse import unquote

from labkit.lesson.cells import MOST, lab_from
from labkit.lesson.day import Day
from labkit.lesson.untrusted_files import (
    MB,
    SCRIPT,
    UnreadError,
    helpers_of,
    read,
    size_of,
)

# In bytes.
LIMITS = {
    "script": SCRIPT,
    "worksheet": 200_000,
    "figure": 8 * MB,
    "log": 4 * MB,
    "notebook": MOST,
}
PICTURES = 40  # pictures of a worksheet that are looked at
IMAGES = (".png", ".jpg", ".jpeg", ".gif", ".svg", ".webp", ".bmp", ".heic", ".tiff")

# Each search ends within a few hundred characters of where it began.
_IMAGE = re.compile(
    r"!\[[^\]\n]{0,300}+\]\([ \t]{0,9}+<?([^)>\s]{1,300}+)[^)\n]{0,300}+\)"
    r"|<img[^>\n]{1,300}?src=[\"']([^\"'\n]{1,300})"
)


@dataclass(frozen=True)
class Item:
    """The state of one deliverable."""

    name: str  # "figure", "definitions", ...
    # Or "todo" (not there yet), "wrong" (there, but), "unfinished" (right as far as it
    # was looked at).
    status: str = "passed"
    message: str = ""  # what is left to do, in one line or several; "" if it passed
    upcoming: str = ""  # its part that is the next step, if it is not the whole

    @property
    def passed(self) -> bool:
        """Nothing is left to do."""
        return self.status in ("passed", "unfinished")


@dataclass(frozen=True)
class Handin:
    """A student's hand-in for a day: files by path from the top, with "/"."""

    files: Mapping[str, bytes] = field(default_factory=dict)  # their content
    unread: Mapping[str, str] = field(default_factory=dict)  # why not, if it is there
    # The worksheet's that are there: whether it is the kit's own.
    pictures: Mapping[str, bool] = field(default_factory=dict)
    # The notebook that the script was made of, if it is handed in instead; or nothing.
    notebook: Mapping[str, bytes] = field(default_factory=dict)


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
    notebook: dict[str, bytes] = {}
    if wanted["script"] not in {*files, *unread}:
        notebook = _notebook(day, root, files, unread)
    files |= helpers_of(root, wanted["script"], files.get(wanted["script"], b""))
    sheet = wanted.get("worksheet", "")
    text = files.get(sheet, b"").decode("utf-8", "replace")
    return Handin(files, unread, _pictures(day, root, sheet, text), notebook)


def notebook_name(day: Day) -> str:
    """Return the path of a day's notebook from the top of a clone, with "/" in it."""
    return f"{posixpath.dirname(day.files['script'])}/{day.notebook.name}"


def _notebook(
    day: Day, root: Path, files: dict[str, bytes], unread: dict[str, str]
) -> dict[str, bytes]:
    """Return a day's notebook by its name, and note the script that it stands for."""
    name, script = notebook_name(day), day.files["script"]
    try:
        data = read(root, name, LIMITS["notebook"])
        if data is None:
            return {}
        lab = lab_from(day, data).encode()
        if len(lab) > SCRIPT:
            raise ValueError("its functions are too long")
    except (UnreadError, ValueError) as error:
        unread[script] = f"is not there, and {name} cannot be used: {error}"
        return {}
    files[script] = lab
    return {name: data}


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


def _pictures(day: Day, root: Path, sheet: str, text: str) -> dict[str, bool]:
    """Return the worksheet's pictures that are there: whether each is the kit's."""
    kits = [day.folder / name for name in day.kit_figures]
    sizes = {path.stat().st_size: path for path in kits if path.is_file()}
    own = {f"{day.folder.name}/{name}" for name in day.kit_figures}
    found: dict[str, bool] = {}
    for address in image_names(text)[:PICTURES]:
        path = picture_path(address, sheet)
        try:
            size = size_of(root, path) if path else None
            kit = path in own
            if size in sizes and not kit:
                kit = read(root, path, LIMITS["figure"]) == sizes[size].read_bytes()
        except UnreadError:
            continue
        if size:
            found[path] = kit
    return found
