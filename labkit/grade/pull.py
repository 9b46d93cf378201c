"""Clone what is missing and update what we cloned, before grading.

A clone that came as an archive brings its own git configuration, which may name
programs to run: it is graded and never pulled. Which clones are ours stands in a file
beside them, with what their configuration was. A new one is made under another name,
noted there, and renamed last: a run that is killed leaves nothing that the next one
does not heal. What a commit may write is `labkit.base.git`'s to say.
"""

import hashlib
import json
import os
import shutil
import time
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from pathlib import Path

from labkit.base import git
from labkit.base.git import GitError
from labkit.base.store import replace
from labkit.base.text import visible
from labkit.grade.roster import Student

AT_ONCE = 8
SECONDS = 300
OURS = ".robo47-clones.json"  # beside the clones
_SAFE = (
    "core.fsmonitor=false",
    f"core.hooksPath={os.devnull}",
    "submodule.recurse=false",
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
    ours = _read(marks)
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
        return known, _update(path)
    if not student.url:
        return known, "there is no such folder, and the roster has no git URL"
    new = _beside(path)
    shutil.rmtree(new, ignore_errors=True)  # of a run that was killed
    bare = ("clone", "-q", "--no-checkout", "--", student.url, new.name)
    problem = _git(path.parent, *bare) or _take(new, "HEAD", "reset", "-q", "--hard")
    if problem:
        shutil.rmtree(new, ignore_errors=True)
    return (known, problem) if problem else (_mark(new), "")


def _beside(path: Path) -> Path:
    """Return where a clone is made: a name that no student's folder has."""
    return path.with_name(f".{hashlib.sha256(os.fsencode(path.name)).hexdigest()[:16]}")


def _move_in(path: Path) -> str:
    """Give a clone that was made beside its name; return what went wrong, or ""."""
    try:
        if _beside(path).exists():
            _beside(path).rename(path)
    except OSError as error:
        return f"the new clone cannot be renamed: {error.strerror}"
    return ""


def _update(clone: Path) -> str:
    """Update our own clone, also after a forced push; return what went wrong, or "".

    What was there before stays: it may be the last work before the deadline.
    """
    problem = _git(clone, "fetch", "-q", "--force", "--no-recurse-submodules")
    (clone / ".git" / "index.lock").unlink(missing_ok=True)  # of a run that was killed
    asked = ("rev-parse", "-q", "--verify")
    had, has = (not _git(clone, *asked, name) for name in ("HEAD", "FETCH_HEAD"))
    if not problem and not had and not has:
        return ""  # nothing was pushed yet
    kept = ("merge-base", "--is-ancestor", "HEAD", "FETCH_HEAD")
    if not problem and had and _git(clone, *kept):
        problem = _git(clone, "update-ref", f"{git.SEEN}{time.time_ns()}", "HEAD")
    return problem or _take(clone, "FETCH_HEAD", "reset", "-q", "--hard", "FETCH_HEAD")


def _take(clone: Path, commit: str, *how: str) -> str:
    """Check out a commit of a sane size, as it is; return what went wrong, or ""."""
    info = clone / ".git" / "info"
    try:
        info.mkdir(exist_ok=True)
        replace(info / "attributes", _AS_IT_IS)
        return git.too_much(clone, commit) or _git(clone, *how)
    except (GitError, OSError) as error:
        return str(error)


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


def _read(marks: Path) -> dict[str, str | None]:
    try:
        found = json.loads(marks.read_bytes())
        return found if isinstance(found, dict) else {}
    except (OSError, ValueError, RecursionError):
        return {}


def _git(folder: Path, *arguments: str) -> str:
    """Run git; return the first line of what it complains of, or ""."""
    settings = [word for setting in _SAFE for word in ("-c", setting)]
    try:
        done = git.run(
            *settings,
            *arguments,
            folder=folder,
            seconds=SECONDS,
            largest=git.LARGEST_GIT,
            GIT_ALLOC_LIMIT=git.LARGEST_OBJECT,
            GIT_LFS_SKIP_SMUDGE="1",
        )
    except GitError as error:
        return str(error)
    if done.returncode == 0:
        return ""
    lines = [ln for ln in done.stderr.splitlines() if ln.strip()]
    return visible(lines[0], 200) if lines else f"git ended with {done.returncode}"
