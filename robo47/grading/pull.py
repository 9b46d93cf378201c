"""Clone what is missing and update what is there, before grading."""

import os
import subprocess
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor, as_completed
from pathlib import Path

from robo47.grading.history import clean_environment
from robo47.grading.roster import Student

AT_ONCE = 8
SECONDS = 300
# What `git clone` and ordinary work leave in a clone's configuration. Anything else may
# name a program to run: such a clone came as an archive, and is graded but not pulled.
_ORDINARY = ("core.", "remote.", "branch.", "user.name", "user.email", "pull.rebase")
_CORE = {
    "repositoryformatversion",
    "filemode",
    "bare",
    "logallrefupdates",
    "ignorecase",
    "precomposeunicode",
    "symlinks",
    "autocrlf",
    "eol",
    "longpaths",
}
_REMOTE = ("url", "fetch", "pushurl", "tagopt", "prune")


def pull_all(students: list[Student]) -> Iterator[tuple[Student, str]]:
    """Clone or update each student's folder, several at a time.

    Yields:
        The student and what went wrong, "" where nothing did.
    """
    usable = [s for s in students if not s.problem]
    with ThreadPoolExecutor(AT_ONCE) as pool:
        waiting = {pool.submit(pull, student): student for student in usable}
        for future in as_completed(waiting):
            yield waiting[future], future.result()


def pull(student: Student) -> str:
    """Clone or update one folder; return what went wrong, or ""."""
    path = student.path
    if not path.exists():
        if not student.url:
            return "there is no such folder, and the roster has no git URL"
        return _git(path.parent, "clone", "-q", "--", student.url, path.name)
    if not (path / ".git").is_dir() or (path / ".git").is_symlink():
        return "it is no git repository"
    if odd := _odd_setting(path):
        return f"its git configuration sets {odd}, which may run a program"
    return _git(path, "pull", "-q", "--ff-only", "--no-recurse-submodules")


def _odd_setting(clone: Path) -> str:
    """Return a setting of the clone that no ordinary clone has, or ""."""
    command = ["git", "config", "--file", str(clone / ".git" / "config")]
    try:
        done = subprocess.run(
            [*command, "--no-includes", "--name-only", "--list", "-z"],
            capture_output=True,
            encoding="utf-8",
            errors="replace",
            env=clean_environment(),
            timeout=SECONDS,
            check=False,
        )
    except (OSError, subprocess.TimeoutExpired):
        return "something git cannot read"
    if done.returncode:
        return "something git cannot read"
    for name in done.stdout.split("\0"):
        last = name.rpartition(".")[2]
        ordinary = not name or name.startswith(_ORDINARY)
        if name.startswith("core."):
            ordinary = last in _CORE
        if name.startswith("remote."):
            ordinary = last in _REMOTE
        if not ordinary:
            return name
    return ""


def _git(folder: Path, *arguments: str) -> str:
    """Run git; return the last line of what it complains of, or ""."""
    safe = ["-c", "core.fsmonitor=false", "-c", f"core.hooksPath={os.devnull}"]
    try:
        done = subprocess.run(
            ["git", *safe, *arguments],
            cwd=folder,
            stdin=subprocess.DEVNULL,
            capture_output=True,
            encoding="utf-8",
            errors="replace",
            env=clean_environment(),
            timeout=SECONDS,
            check=False,
        )
    except subprocess.TimeoutExpired:
        return f"git took more than {SECONDS} s"
    except OSError as error:
        return f"git cannot be run: {error.strerror}"
    if done.returncode == 0:
        return ""
    lines = [ln for ln in done.stderr.splitlines() if ln.strip()]
    return lines[0].strip() if lines else f"git ended with {done.returncode}"
