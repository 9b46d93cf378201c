"""Clone what is missing and update what we cloned, before grading.

A clone that came as an archive brings its own git configuration, which may name
programs to run: it is graded and never pulled. Which clones are ours stands in a file
beside them, with what their configuration was. A new one is made under another name,
noted there, and renamed last: a run that is killed leaves nothing that the next one
does not heal. What a commit may write is `labkit.base.git`'s to say. Which branch is
taken is the server's to say, by name, and the clone's HEAD has that name.
"""

import hashlib
import json
import os
import re
import shutil
import subprocess
import time
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from pathlib import Path
from typing import Any

from labkit.base import git
from labkit.base.git import GitError
from labkit.base.store import replace
from labkit.base.text import visible
from labkit.grade.roster import Student

AT_ONCE = 8
SECONDS = 300
OURS = ".robo47-clones.json"  # a file beside the clones
HEADS = "refs/heads/"
SHOWN = 5  # branches that are named
_NAME = re.compile(r"[^\0-\x20~^:?*\[\\\x7f]+")  # a name that git accepts for a branch
_SAFE = (
    "core.fsmonitor=false",
    f"core.hooksPath={os.devnull}",
    "submodule.recurse=false",
    "protocol.fd.allow=never",  # a roster's address of ours, at which git waits
    "http.lowSpeedLimit=1000",
    "http.lowSpeedTime=30",
)
# Git may write a file many times as large as it is where the commit asks for it.
_AS_IT_IS = b"* -text -ident !filter !working-tree-encoding\n"
_NOT_OURS = (
    "make grade did not clone it, or its git configuration was changed since. Move the "
    "folder away to have it cloned anew"
)


def pull_all(students: Sequence[Student]) -> Iterator[tuple[Student, str]]:
    """Clone or update each student's folder, several at a time.

    Yields:
        The student and what went wrong, "" where nothing did.
    """
    usable = [s for s in students if not s.problem]
    if not usable:
        return
    marks = usable[0].path.parent / OURS
    ours = _marks(marks)
    with ThreadPoolExecutor(AT_ONCE) as pool:
        waiting = {pool.submit(pull, s, ours.get(s.folder)): s for s in usable}
        for future in as_completed(waiting):
            student = waiting[future]
            mark, problem = future.result()
            if mark != ours.get(student.folder):
                ours[student.folder] = mark
                replace(marks, json.dumps(ours, indent=1).encode())
            yield student, problem or _move_in(student.path)


def pull(student: Student, known: str | None) -> tuple[str | None, str]:
    """Clone or update one folder.

    Args:
        student: whose.
        known: the mark of our clone, or None.

    Returns:
        The mark from now on, and what went wrong, or "".
    """
    path = student.path
    if path.exists():
        if known is None or known != _mark(path):
            return known, _NOT_OURS
        return known, _problem(_update, path)
    if not student.url:
        return known, "there is no such folder, and the roster has no git URL"
    new = _temporary_path(path)
    # the folder may be left from a run that was killed
    problem = _problem(_remove, new)
    if problem := problem or _problem(_clone, new, student.url):
        _problem(_remove, new)
        return known, problem
    return _mark(new), ""


def _problem(work: Callable[..., None], *arguments: Any) -> str:
    """Do it; return what went wrong, or ""."""
    try:
        work(*arguments)
    except (GitError, OSError) as error:
        return str(error)
    except RecursionError:
        return "its folders are too deep in each other: remove it by hand"
    return ""


def _remove(folder: Path) -> None:
    shutil.rmtree(folder, ignore_errors=True)


def _clone(new: Path, url: str) -> None:
    how = ("-q", "--no-checkout", "--origin=origin")  # whatever their settings say
    _git(new.parent, "clone", *how, "--", url, new.name)
    _update(new)


def _temporary_path(path: Path) -> Path:
    """Return where a clone is made: a name that no student's folder has."""
    return path.with_name(f".{hashlib.sha256(os.fsencode(path.name)).hexdigest()[:16]}")


def _move_in(path: Path) -> str:
    """Give a clone that was made beside its name; return what went wrong, or ""."""
    try:
        if _temporary_path(path).exists():
            _temporary_path(path).rename(path)
    except OSError as error:
        return f"the new clone cannot be renamed: {error.strerror}"
    return ""


def _update(clone: Path) -> None:
    """Update our own clone, also after a forced push.

    What was there before stays: it may be the last work before the deadline.

    Raises:
        GitError, OSError: what went wrong.
    """
    _clear(clone / ".git")
    name = _branch(clone)
    if not name:
        return
    how = ("-q", "--force", "--no-tags", "--no-recurse-submodules", "--refmap=")
    _git(clone, "fetch", *how, "origin", f"{HEADS}{name}")
    commit = _git(clone, "rev-parse", "FETCH_HEAD^{commit}").strip()
    if too_much := git.too_much(clone, commit):
        raise GitError(too_much)
    before = git.branch_of(clone)
    if _is(clone, "rev-parse", "-q", "--verify", "HEAD") and (
        before != name or not _is(clone, "merge-base", "--is-ancestor", "HEAD", commit)
    ):
        _git(clone, "update-ref", f"{git.SEEN}{time.time_ns()}", "HEAD")
    if before != name:
        _git(clone, "symbolic-ref", "HEAD", f"{HEADS}{name}")
        if before:  # git has no branch "a" beside a branch "a/b"
            _git(clone, "update-ref", "-d", f"{HEADS}{before}")
    info = clone / ".git" / "info"
    info.mkdir(exist_ok=True)
    replace(info / "attributes", _AS_IT_IS)
    whole = _is(clone, "ls-files", "--", ".git")  # it reads the index
    if not whole:  # the power was cut
        (clone / ".git" / "index").unlink(missing_ok=True)
    _git(clone, "reset", "-q", "--hard", commit)
    if not whole:  # remove the files that the new commit no longer has
        _git(clone, "clean", "-q", "-ffdx")
    if not _git(clone, "for-each-ref", f"--points-at={commit}", git.PULLED):
        _git(clone, "update-ref", f"{git.PULLED}{int(time.time())}", commit)


def _clear(folder: Path) -> None:
    """Remove what a git that was killed leaves in our clone: locks, half a pack."""
    left = [*folder.glob("*.lock"), *(folder / "refs").rglob("*.lock")]
    for path in [*left, *(folder / "objects" / "pack").glob("tmp_*")]:
        path.unlink(missing_ok=True)


def _branch(clone: Path) -> str:
    """Return which branch is graded; "" where nothing was pushed yet.

    It is the server's default one. Where the server names none that is there, it is
    the one that was taken before, or the only one; never one that is guessed.

    Raises:
        GitError: there is none such, or the server does not answer.
    """
    told = _git(clone, "ls-remote", "--symref", "origin", "HEAD", f"{HEADS}*")
    default = ""
    there = []
    for what, _, name in (line.partition("\t") for line in told.splitlines()):
        if name == "HEAD" and what.startswith(f"ref: {HEADS}"):
            default = what.removeprefix(f"ref: {HEADS}")
        elif name.startswith(HEADS) and _NAME.fullmatch(name):
            there.append(name.removeprefix(HEADS))
    before = ""
    if _is(clone, "rev-parse", "-q", "--verify", "HEAD"):
        before = git.branch_of(clone)
    for name in (default, before):
        if name in there:
            return name
    if not before and len(there) < 2:
        return there[0] if there else ""
    others = ", ".join(there[:SHOWN]) + (", ..." if len(there) > SHOWN else "")
    none = "the server names none of its branches as the default"
    if before:
        none = (
            f"the branch {before} is gone from the server, and no other is its default"
        )
    raise GitError(visible(f"{none} ({others or 'it has none'})", 200))


def _mark(clone: Path) -> str | None:
    """Return what tells our clone from any other: a hash of its configuration."""
    folder = clone / ".git"
    config = clone / ".git" / "config"
    try:
        if any(path.is_symlink() for path in (folder, config)) or not config.is_file():
            return None
        if os.path.lexists(folder / "commondir"):
            return None
        return hashlib.sha256(config.read_bytes()).hexdigest()
    except OSError:
        return None


def _marks(marks: Path) -> dict[str, str | None]:
    try:
        found = json.loads(marks.read_bytes())
        return found if isinstance(found, dict) else {}
    except (OSError, ValueError, RecursionError):
        return {}


def _git(folder: Path, *arguments: str) -> str:
    """Return what git prints.

    Raises:
        GitError: with the first line of what it complains of.
    """
    done = _run(folder, *arguments)
    if done.returncode == 0:
        return str(done.stdout)
    lines = [ln for ln in done.stderr.splitlines() if ln.strip()]
    why = visible(lines[0], 200) if lines else f"git ended with {done.returncode}"
    raise GitError(why)


def _is(folder: Path, *arguments: str) -> bool:
    """Return whether git says yes."""
    return bool(_run(folder, *arguments).returncode == 0)


def _run(folder: Path, *arguments: str) -> subprocess.CompletedProcess[Any]:
    settings = [word for setting in _SAFE for word in ("-c", setting)]
    return git.run(
        *settings,
        *arguments,
        folder=folder,
        seconds=SECONDS,
        largest=git.LARGEST_GIT,
        GIT_ALLOC_LIMIT=git.LARGEST_OBJECT,
    )
