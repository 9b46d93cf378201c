"""The package that is graded: a few files as bytes, and what git said of them.

Of a folder as it is, or of its last commit before the deadline.
"""

import errno
import hashlib
import json
import os
import tempfile
import time
from dataclasses import dataclass, field, replace
from functools import cache
from pathlib import Path, PurePosixPath

from labkit.base.git import (
    History,
    before,
    blob,
    files_of,
    pulled_at,
    read_history,
    short_sha,
)
from labkit.grade.roster import Student
from labkit.handin.deliverables import check_commit, wanted_names
from labkit.handin.handin import (
    LIMITS,
    PICTURES,
    Handin,
    Item,
    image_names,
    notebook_name,
    picture_path,
    read_handin,
)
from labkit.handin.whereabouts import whereabouts
from labkit.lesson.day import Day, find_day
from labkit.lesson.untrusted_files import HELPERS, NO_NAME
from robo47 import __version__
from robo47.paths import ROOT

FOLDER = "robo47-commit-"
LARGEST = max(LIMITS.values())  # bytes of a file that is looked at
MOST = 4 * HELPERS  # files beside the script: one blob may have any number of names
# These files decide a grade: the code, the manifests, the solution, the templates of
# definitions and drawings. `work/` is somebody's own.
_DECIDES = (
    "robo47/**/*.py",
    "labkit/**/*.py",
    "w*/week.toml",
    "w*/day*/**/*.toml",
    "w*/day*/**/*.py",
    "w*/day*/**/*.xml",
    "w*/src/*.py",
)


CLOCKS_APART = 3600  # seconds that two clocks may differ


@dataclass(frozen=True)
class Package:
    """One submission for one day, without the student's name."""

    day: int  # its number
    kit: str  # fingerprint of the kit that collected it; no other may grade it
    handin: Handin = field(default_factory=Handin)  # the files
    # The deliverable "commit", which only the clone can tell.
    commit_item: Item = field(default_factory=lambda: Item("commit", "todo"))
    commit: str = ""  # the hash of the commit that counts; "" without one
    # Its time by the student's own clock, seconds since 1970, or None.
    committed: int | None = None
    problem: str = ""  # why there is nothing to grade; "" where there is
    seed: int = 0  # the seed of the fresh inputs, the same for everybody
    version: str = ""  # the version of the kit that collected it, in words
    branch: str = ""  # the branch that the clone stands on
    late: int = 0  # the number of commits after the deadline
    elsewhere: str = ""  # a sentence on where the script is, when it is not in place
    clock: str = ""  # the fault of the student's clock; "" if there is none

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
            self.elsewhere,
            *([self.clock] if self.clock else []),
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
    student: Student,
    day: Day,
    seed: int = 0,
    deadline: int | None = None,
    at: str = "",
) -> Package:
    """Return what a student hands in.

    Args:
        student: from the roster.
        day: from the kit's manifest.
        seed: of the fresh inputs.
        deadline: seconds since 1970, or None.
        at: the commit that counts, whatever the deadline.

    Raises:
        OSError, GitError: this machine failed.
    """
    kit = fingerprint(day.number)
    package = Package(day.number, kit, seed=seed, version=version())
    problem = student.problem  # first: a link is not followed, not even to look
    if not problem and not student.path.is_dir():
        problem = "there is no such folder"
    if problem:
        return replace(package, problem=problem)
    handin, history, late = read_in_time(day, student.path, deadline, at)
    day = day.named_as(lambda name: name in handin.files)
    elsewhere = ""
    if not {*handin.files, *handin.unread} & {day.files["script"]}:
        elsewhere = whereabouts(day, student.path, history.commit)
    return replace(
        package,
        elsewhere=elsewhere,
        handin=handin,
        commit_item=check_commit(day, handin, history),
        commit=history.commit,
        committed=_when(student.path, history),
        clock=_wrong_clock(read_history(student.path, ()).committed),
        branch=history.branch,
        late=late,
    )


def _when(clone: Path, history: History) -> int | None:
    """Return a commit's time: by its own clock, but not after it was pulled, or now."""
    seen = pulled_at(clone, history.commit) if history.commit else None
    if history.committed is None or (seen is not None and seen < history.committed):
        return seen
    return None if _wrong_clock(history.committed) else history.committed


def _wrong_clock(committed: int | None) -> str:
    """Return that a commit is dated later than now; "" where it is not."""
    if committed is None or committed <= time.time() + CLOCKS_APART:
        return ""
    dated = time.strftime("%Y-%m-%d %H:%M", time.gmtime(committed))
    return (
        f"the last commit is dated {dated} UTC by its own clock, which is later than "
        "now; a commit that make grade pulled before the deadline is in time anyway"
    )


def read_in_time(
    day: Day, clone: Path, deadline: int | None, at: str = ""
) -> tuple[Handin, History, int]:
    """Return what a student hands in, its commit, and how many commits came too late.

    Where the last commit is late, the last one that is not counts; where all are late,
    the last one. Uncommitted work counts as long as no commit is late.

    Args:
        day: from the kit's manifest.
        clone: the student's folder.
        deadline: seconds since 1970, or None.
        at: the commit that counts; the folder as it is, where that is its last one.

    Raises:
        OSError, GitError: this machine failed.
    """
    handin = read_handin(_as_there(day, clone), clone)
    history = read_history(clone, wanted_names(day, handin))
    is_late = history.committed is None or history.committed > (deadline or 0)
    if at == history.commit or not history.commit:
        return handin, history, 0
    if not at and (deadline is None or not is_late):
        return handin, history, 0
    commit, late = (at, 0) if at else before(clone, deadline or 0, _work(day))
    if not commit:
        return handin, history, late
    with tempfile.TemporaryDirectory(prefix=FOLDER) as folder:
        _check_out(day, clone, commit, Path(folder))
        handin = read_handin(_as_there(day, Path(folder)), Path(folder))
    return handin, read_history(clone, wanted_names(day, handin), at=commit), late


def _as_there(day: Day, root: Path) -> Day:
    return day.named_as(lambda name: os.path.isfile(root / name))


def _work(day: Day) -> str:
    """Return the folder of a student's labs, as git has it."""
    return f"{Path(day.files['script']).parent.as_posix()}/"


def _check_out(day: Day, clone: Path, commit: str, folder: Path) -> None:
    """Write what a day may hand in of a commit, without running anything of git's."""
    names = [*day.files.values(), notebook_name(day)]
    _write(clone, files_of(clone, commit, *names), folder)
    beside = files_of(clone, commit, _work(day)).items()
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
            try:
                os.truncate(path, size)
            except (OSError, OverflowError):  # a claim that no disk can hold
                os.truncate(path, largest + 1)


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
