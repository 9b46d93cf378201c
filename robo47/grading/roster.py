"""Who is in the class: the folders of ROOT, or the rows of a roster."""

import csv
import os
from dataclasses import dataclass
from pathlib import Path

from robo47.errors import Robo47Error
from robo47.paths import shown

_URL = ("git", "url", "git url", "git_url", "repo")
_ASKED = "expected columns: name, folder and, for --pull, git"


@dataclass(frozen=True)
class Student:
    """One row of the results.

    Attributes:
        name: to show.
        folder: its name in ROOT; no two students have the same.
        path: the folder.
        url: where to clone it from; "" where the roster does not say.
        problem: why the folder cannot be used; "" where it can.
    """

    name: str
    folder: str
    path: Path
    url: str = ""
    problem: str = ""


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
    if (root / "w1-foundations").is_dir():
        raise Robo47Error(
            f"{shown(root)} is itself a clone; give the folder that holds the clones"
        )
    if roster or (root / "roster.csv").is_file():
        students = _read_roster(roster or root / "roster.csv", root)
    else:
        with os.scandir(root) as entries:
            folders = [e for e in entries if e.name[0] != "." and e.is_dir()]
        names = sorted(entry.name for entry in folders)
        students = [_student(name, name, root) for name in names]
    if not students:
        raise Robo47Error(
            f"{shown(root)} has no folders; expected one clone per student, or a "
            "roster.csv and --pull"
        )
    return students


def _student(name: str, folder: str, root: Path, url: str = "") -> Student:
    path, problem = root / folder, ""
    if folder in ("", ".", "..") or "\0" in folder or Path(folder).name != folder:
        path, problem = root, f"{folder!r} is no name of a folder"
    elif path.is_symlink():
        problem = "the folder is a link, which is not followed"
    elif url.startswith("-"):
        problem = f"{url!r} is no git URL"
    return Student(name or folder, folder, path, url, problem)


def _read_roster(path: Path, root: Path) -> list[Student]:
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
    rows = csv.reader(text.splitlines(), delimiter=delimiter)
    columns = [name.strip().lower() for name in next(rows, [])]
    if "folder" not in columns:
        raise Robo47Error(f"{shown(path)} has no column folder; {_ASKED}")
    students: dict[str, Student] = {}
    for row in rows:
        cells = dict(zip(columns, map(str.strip, row), strict=False))
        if not any(cells.values()):
            continue
        folder = cells.get("folder", "")
        if folder in students:
            raise Robo47Error(
                f"{shown(path)}, line {rows.line_num}: folder {folder!r} is listed "
                "twice; expected one folder per student"
            )
        url = next((cells[name] for name in _URL if cells.get(name)), "")
        students[folder] = _student(cells.get("name", ""), folder, root, url)
    return list(students.values())
