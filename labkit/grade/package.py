"""The package that is graded: a few files as bytes, and what git said of them."""

import hashlib
import json
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path, PurePosixPath

from labkit.base.git import read_history
from labkit.grade.roster import Student
from labkit.handin.commit import check_commit, wanted_names
from labkit.handin.handin import Handin, read_handin
from labkit.handin.item import Item
from labkit.lesson.day import Day, find_day
from robo47.paths import ROOT

# What decides a grade: the code, the manifests, the solution, what a definition and a
# drawing must not be. `work/` is somebody's own.
_DECIDES = (
    "robo47/**/*.py",
    "labkit/**/*.py",
    "w*/week.toml",
    "w*/day*/**/*.toml",
    "w*/day*/**/*.py",
    "w*/src/*.py",
)


@dataclass(frozen=True)
class Package:
    """One submission for one day, without the student's name.

    Attributes:
        day: its number.
        kit: fingerprint of the kit that collected it; no other may grade it.
        handin: the files.
        commit_item: the deliverable "commit", which only the clone can tell.
        commit: the hash of the last commit; "" without one.
        committed: its time by the student's own clock, seconds since 1970, or None.
        problem: why there is nothing to grade; "" where there is.
    """

    day: int
    kit: str
    handin: Handin = field(default_factory=Handin)
    commit_item: Item = field(default_factory=lambda: Item("commit", "todo"))
    commit: str = ""
    committed: int | None = None
    problem: str = ""

    @property
    def fingerprint(self) -> str:
        """A hash of all that the grade depends on, but for the kit."""
        item, handin = self.commit_item, self.handin
        facts = [
            self.day,
            sorted((name, _hash(data)) for name, data in handin.files.items()),
            sorted(handin.unread.items()),
            sorted(handin.pictures.items()),
            [item.name, item.status, item.message, self.commit, self.committed],
            self.problem,
        ]
        return _hash(json.dumps(facts).encode("ascii"))

    def modules(self) -> dict[str, bytes]:
        """Return the student's own Python files, by name without a folder."""
        files = self.handin.files.items()
        named = {PurePosixPath(name): data for name, data in files}
        return {
            path.name: data
            for path, data in named.items()
            if path.suffix == ".py" and path.stem.isidentifier()
        }


def collect(student: Student, day: Day) -> Package:
    """Return what a student hands in.

    Args:
        student: from the roster.
        day: from the kit's manifest.

    Raises:
        OSError, GitError: this machine failed.
    """
    kit = fingerprint(day.number)
    problem = student.problem
    if not problem and not student.path.is_dir():
        problem = "there is no such folder"
    if problem:
        return Package(day.number, kit, problem=problem)
    handin = read_handin(day, student.path)
    history = read_history(student.path, wanted_names(day, handin))
    item = check_commit(day, handin, history)
    return Package(day.number, kit, handin, item, history.commit, history.committed)


@cache
def fingerprint(number: int) -> str:
    """Return a hash of what decides a grade for a day; two kits are never mixed."""
    day = find_day(number)
    files = {path for pattern in _DECIDES for path in ROOT.glob(pattern)}
    files |= {day.folder / day.guide, *(day.folder / name for name in day.kit_figures)}
    names = {
        path.relative_to(ROOT).as_posix(): path for path in files if path.is_file()
    }
    whole = hashlib.sha256()
    for name in sorted(names):  # the same order and line ends on every system
        data = names[name].read_bytes()
        if names[name].suffix != ".png":
            data = data.replace(b"\r\n", b"\n")
        whole.update(f"{name}\0{_hash(data)}\0".encode())
    return whole.hexdigest()[:16]


def unpack(package: Package, folder: Path) -> None:
    """Write a submission's Python files into a folder; nothing else of it is written.

    Args:
        package: one submission.
        folder: a new one.
    """
    for name, data in package.modules().items():
        (folder / name).write_bytes(data)


def _hash(data: bytes) -> str:
    return hashlib.sha256(data).hexdigest()
