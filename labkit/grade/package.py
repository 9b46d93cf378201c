"""The package that is graded: a few files as bytes, and what git said of them."""

import hashlib
import json
from dataclasses import dataclass, field, replace
from functools import cache
from pathlib import Path, PurePosixPath

from labkit.base.git import short_sha
from labkit.grade.in_time import read_in_time
from labkit.grade.roster import Student
from labkit.handin.deliverables import check_commit
from labkit.handin.handin import Handin, Item
from labkit.lesson.day import Day, find_day
from robo47 import __version__
from robo47.paths import ROOT

# What decides a grade: the code, the manifests, the solution, what a definition and a
# drawing must not be. `work/` is somebody's own.
_DECIDES = (
    "robo47/**/*.py",
    "labkit/**/*.py",
    "w*/week.toml",
    "w*/day*/**/*.toml",
    "w*/day*/**/*.py",
    "w*/day*/**/*.xml",
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
        commit: the hash of the commit that counts; "" without one.
        committed: its time by the student's own clock, seconds since 1970, or None.
        problem: why there is nothing to grade; "" where there is.
        seed: of the fresh inputs, the same for everybody.
        version: of the kit that collected it, in words.
        late: how many commits came after the deadline.
    """

    day: int
    kit: str
    handin: Handin = field(default_factory=Handin)
    commit_item: Item = field(default_factory=lambda: Item("commit", "todo"))
    commit: str = ""
    committed: int | None = None
    problem: str = ""
    seed: int = 0
    version: str = ""
    late: int = 0

    @property
    def fingerprint(self) -> str:
        """A hash of all that the grade depends on, but for the kit."""
        item, handin = self.commit_item, self.handin
        facts = [
            [self.day, self.seed],
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


def collect(
    student: Student, day: Day, seed: int = 0, deadline: int | None = None
) -> Package:
    """Return what a student hands in.

    Args:
        student: from the roster.
        day: from the kit's manifest.
        seed: of the fresh inputs.
        deadline: seconds since 1970, or None.

    Raises:
        OSError, GitError: this machine failed.
    """
    package = Package(day.number, fingerprint(day.number))
    package = replace(package, seed=seed, version=version())
    problem = student.problem
    if not problem and not student.path.is_dir():
        problem = "there is no such folder"
    if problem:
        return replace(package, problem=problem)
    handin, history, late = read_in_time(day, student.path, deadline)
    day = day.named_as(lambda name: name in handin.files)
    return replace(
        package,
        handin=handin,
        commit_item=check_commit(day, handin, history),
        commit=history.commit,
        committed=history.committed,
        late=late,
    )


@cache
def version() -> str:
    """Return this kit's version and commit, "0.1.0 (ff9d311)"."""
    commit = short_sha(ROOT)
    return f"{__version__} ({commit})" if commit else __version__


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
