"""The last step of an update: a clone becomes what a worktree beside it is, or stays.

Files move one by one, each whole, since they are on the same disk; then the index and
HEAD follow. A note in `.robo47/` stands for as long as that lasts: whoever finds one
puts back what moved, so a run may end anywhere. What is in the clone and in neither
commit is the student's: nothing is written over it.
"""

import contextlib
import json
import os
from collections.abc import Iterable
from pathlib import Path, PurePosixPath

from labkit.base import store
from labkit.lesson.week import WORK
from labkit.update.git import ask, own_index, worktree_at
from robo47.errors import Robo47Error
from robo47.paths import ROOT

NOTE = "update.json"
SHOWN = 5  # files that are named
UNCHANGED = "Nothing of yours has changed."
AMID = "It stopped amid its last step. Once more, which puts it right: make update"


def state() -> str:
    """Return what an update that ends now leaves behind."""
    return AMID if store.path_of(NOTE).is_file() else UNCHANGED


def take(worktree: Path, own: str) -> None:
    """Bring the clone to what a worktree has.

    Args:
        worktree: at a commit that is made.
        own: the commit that the clone's files are as.

    Raises:
        Robo47Error: a file is in the way, and is named; or git or the disk fails.
    """
    now = ask("rev-parse", "HEAD")
    to = ask("rev-parse", "HEAD", at=worktree)
    names = _changed(own, to)
    # A blocked path differs from both commits.
    if blocked := sorted(_differing(to, names) & _differing(own, names)):
        shown = ", ".join(blocked[:SHOWN]) + (", ..." if blocked[SHOWN:] else "")
        if ask("ls-tree", "--name-only", own, "--", *blocked[:SHOWN]):
            raise Robo47Error(f"changed meanwhile: {shown}. Once more: make update")
        raise Robo47Error(
            f"these are yours, and the newer kit has files of these names: {shown}. "
            "Move or rename yours, then: make update"
        )
    lock = _of_git("index") + ".lock"
    if os.path.lexists(ROOT / lock):
        raise Robo47Error(
            f"another git is at work in this folder, or was killed: {lock} is there. "
            "Wait for it, or remove that file, then: make update"
        )
    try:
        note = json.dumps({"now": now, "own": own, "to": to})
        store.replace(store.path_of(NOTE), note.encode(), sync=True)
        _move(worktree, names)
        ask("read-tree", to)
        ask("update-ref", "-m", "make update", "HEAD", to, now)
        ask("update-index", "-q", "--refresh", may_fail=True)
    except BaseException as error:  # Ctrl-C as well
        with contextlib.suppress(Robo47Error, OSError):  # then the next run does it
            heal()
        if isinstance(error, OSError):
            where = error.filename2 or error.filename or "a file"
            raise Robo47Error(f"{where} cannot be written: {error.strerror}") from None
        raise
    store.path_of(NOTE).unlink()


def heal() -> None:
    """Put back what a run that ended in its last step had moved.

    Raises:
        Robo47Error, OSError: that fails as well; the note stays.
    """
    note = store.read(NOTE)
    if note:
        now, own, to = (str(note.get(name)) for name in ("now", "own", "to"))
        known = ("rev-parse", "-q", "--verify", "--end-of-options")
        whole = all(
            ask(*known, f"{one}^{{commit}}", may_fail=True) for one in (own, to)
        )
        for name in ("index", "HEAD", ask("rev-parse", "--symbolic-full-name", "HEAD")):
            (ROOT / f"{_of_git(name)}.lock").unlink(missing_ok=True)
        head = ask("rev-parse", "HEAD")
        if head == now != to and whole:
            names = _changed(own, to)
            with worktree_at(own) as worktree:
                _move(worktree, set(names) - _differing(to, names))
        if head in (now, to):
            ask("reset", "-q")
    with contextlib.suppress(FileNotFoundError, NotADirectoryError):
        # The note goes, since the student went on from there.
        store.path_of(NOTE).unlink()


def _changed(own: str, to: str) -> list[str]:
    """Return the files that differ between two commits."""
    listed = ask("diff-tree", "-r", "-z", "--name-only", "--no-renames", own, to)
    return [name for name in listed.split("\0") if name]


def _differing(commit: str, names: list[str]) -> set[str]:
    """Return which files the clone does not have as a commit has them."""
    with own_index() as index:
        ask("read-tree", commit, index=index)
        ask("update-index", "-q", "--refresh", may_fail=True, index=index)
        has = set(ask("ls-files", "-z", index=index).split("\0"))
        other = set(ask("diff-files", "-z", "--name-only", index=index).split("\0"))
    whole = set(names)
    return {n for n in names if (n in other if n in has else _stands(n, whole))}


def _stands(name: str, names: set[str]) -> bool:
    """Return whether something is where a file would go, besides `names` themselves."""
    for above in reversed(PurePosixPath(name).parents[:-1]):
        path = ROOT / above
        if path.is_symlink() or path.is_file():
            return above.as_posix() not in names
    path = ROOT / name
    if not path.is_dir() or path.is_symlink():
        return os.path.lexists(path)
    below = (one for one in path.rglob("*") if _is_file(one))
    return any(one.relative_to(ROOT).as_posix() not in names for one in below)


def _move(worktree: Path, names: Iterable[str]) -> None:
    """Give the clone a worktree's files of these names, or take its own away."""
    new = [name for name in names if _is_file(worktree / name)]
    for path in (ROOT / name for name in set(names) - set(new)):
        if _is_file(path):
            path.unlink()
            _remove_empty(path.parent)
    for name in new:
        source, path = worktree / name, ROOT / name
        if PurePosixPath(name).match(f"w*/{WORK}/day*.py") and path.is_file():
            # a file that the kit merged was not edited by the student
            was = path.stat()
            os.utime(source, ns=(was.st_atime_ns, was.st_mtime_ns))
        if path.is_dir() and not path.is_symlink():
            for folder in sorted(path.rglob("*"), reverse=True):
                folder.rmdir()
            path.rmdir()
        path.parent.mkdir(parents=True, exist_ok=True)
        source.replace(path)


def _is_file(path: Path) -> bool:
    return path.is_symlink() or path.is_file()


def _remove_empty(folder: Path) -> None:
    """Remove a folder, and those around it, for as long as they are empty."""
    with contextlib.suppress(OSError):
        while folder != ROOT:
            folder.rmdir()
            folder = folder.parent


def _of_git(name: str) -> str:
    """Return where git has a file of its own, from the top of the clone."""
    return ask("rev-parse", "--git-path", name)
