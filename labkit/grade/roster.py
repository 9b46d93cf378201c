"""The class's roster: the folders of ROOT, or the rows of a roster.

Names are data: they are shown, and a file that is named after one is named by us.
"""

import csv
import hashlib
import io
import os
import re
import unicodedata
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

from labkit.base.text import visible
from robo47.errors import Robo47Error
from robo47.paths import shown

_URL = ("git", "url", "git url", "git_url", "repo")
_ID = ("id", "email", "username", "number")
_DEVICES = re.compile(r"(con|prn|aux|nul|com\d|lpt\d)(\.|$)", re.IGNORECASE)
LONGEST = 100  # bytes of a file's name before its ending; systems allow 255
_ASKED = "expected columns: name, folder and, for --pull, git"


@dataclass(frozen=True)
class Student:
    """One row of the results."""

    name: str  # the name to show, on one line
    folder: str  # its name in ROOT; no two students have the same
    path: Path  # the folder
    url: str = ""  # the address to clone from; "" if the roster gives none
    problem: str = ""  # why the folder cannot be used; "" where it can
    id: str = ""  # the student's ID in a learning platform; "" if none is given
    # All that the roster says, by column, in small letters.
    cells: Mapping[str, str] = field(default_factory=dict, compare=False, repr=False)
    file: str = ""  # a name for files about them, without its ending


def find_students(root: Path, roster: Path | None = None) -> list[Student]:
    """Return the class, in the roster's order or by folder name.

    Args:
        root: the folder with one clone per student.
        roster: a CSV of name, folder and git URL; default `root/roster.csv` if there.

    Raises:
        Robo47Error: no such folder, nobody in it, or a roster that cannot be read.
    """
    if not root.is_dir():
        raise Robo47Error(
            f"{shown(root)} is no folder; expected one that holds a clone per student"
        )
    if any(root.glob("w*/day*/day.toml")):
        raise Robo47Error(
            f"{shown(root)} is itself a clone; give the folder that holds the clones"
        )
    if roster or (root / "roster.csv").is_file():
        students = _read_roster(roster or root / "roster.csv", root)
    else:
        with os.scandir(root) as entries:
            folders = [e for e in entries if e.name[0] != "." and e.is_dir()]
        names = sorted(entry.name for entry in folders)
        students = [_student({"name": name, "folder": name}, root) for name in names]
    if not students:
        raise Robo47Error(
            f"{shown(root)} has no folders; expected one clone per student, or a "
            "roster.csv and --pull"
        )
    files = file_names(student.folder for student in students)
    return [replace(student, file=files[student.folder]) for student in students]


def file_names(folders: Iterable[str]) -> dict[str, str]:
    """Return a file name for each student: none leaves its folder, no two are alike.

    Args:
        folders: the students' folders, whatever a roster says of them. One that any
            system can have as a file's name is kept; others get a hash.
    """
    safe = {folder: _safe(folder) for folder in folders}
    alike = Counter(_key(name) for folder, name in safe.items() if name == folder)
    return {
        folder: name
        if name == folder and alike[_key(name)] == 1
        else f"{name}-{hashlib.sha256(os.fsencode(folder)).hexdigest()[:12]}"
        for folder, name in safe.items()
    }


def _safe(folder: str) -> str:
    """Return a folder's last part without what a system may not have in a name."""
    last = re.split(r"[/\\]", folder.rstrip("/\\"))[-1]
    name = re.sub(r'[<>:"|?*]', "_", visible(last)).strip(". ")
    name = name.encode()[:LONGEST].decode("utf-8", "ignore").strip(". ")
    return f"_{name}" if not name or _DEVICES.match(name) else name


def _key(name: str) -> str:
    return unicodedata.normalize("NFC", name).casefold()  # some systems see no case


def _student(cells: Mapping[str, str], root: Path) -> Student:
    """Return the student whom a roster's row, by column, is about."""
    folder = cells.get("folder", "")
    url, id = (
        next((cells[name] for name in names if cells.get(name)), "")
        for names in (_URL, _ID)
    )
    path = root / folder
    problem = ""
    try:
        if folder[:1] in ("", ".") or "\0" in folder or Path(folder).name != folder:
            path = root
            problem = f"{folder!r} is no name of a folder"
        elif path.is_symlink():
            problem = "the folder is a link, which is not followed"
        elif url.startswith("-") or "\0" in url:
            problem = f"{url!r} is no git URL"
    except OSError as error:  # too long for a name
        path = root
        problem = f"no name of a folder here: {error}"
    name = cells.get("name") or cells.get("student", "")
    name = name or os.fsencode(folder).decode("utf-8", "backslashreplace")
    return Student(
        visible(name, 120),
        folder,
        path,
        url=url,
        problem=visible(problem),
        id=visible(id, 120),
        cells=cells,
    )


def _read_roster(path: Path, root: Path) -> list[Student]:
    students: dict[str, Student] = {}
    for number, cells in _rows(path):
        folder = cells.get("folder", "")
        if folder in students:
            raise Robo47Error(
                f"{shown(path)}, line {number}: folder {folder!r} is listed "
                "twice; expected one folder per student"
            )
        students[folder] = _student(cells, root)
    return list(students.values())


def _rows(path: Path) -> Iterator[tuple[int, dict[str, str]]]:
    """Yield the line and the cells, by column, of each row that has some."""
    try:
        text = path.read_text("utf-8-sig")
    except OSError as error:
        raise Robo47Error(
            f"{shown(path)} cannot be read: {error.strerror or error}"
        ) from None
    except UnicodeDecodeError:
        raise Robo47Error(
            f"{shown(path)} is not in UTF-8: save it as 'CSV UTF-8'"
        ) from None
    head = text.partition("\n")[0]
    delimiter = max(",;\t", key=head.count)  # a spreadsheet writes its country's own
    # A name may hold what Python takes for the end of a line, and a spreadsheet not.
    rows = csv.reader(io.StringIO(text, newline=""), delimiter=delimiter)
    try:
        columns = [name.strip().lower() for name in next(rows, [])]
        if "folder" not in columns:
            raise Robo47Error(f"{shown(path)} has no column folder; {_ASKED}")
        for row in rows:
            cells = dict(zip(columns, map(str.strip, row), strict=False))
            if any(cells.values()):
                yield rows.line_num, cells
    except csv.Error as error:
        says = f"{shown(path)}, line {rows.line_num}: {error}; save it as CSV anew"
        raise Robo47Error(says) from None
