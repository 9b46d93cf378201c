"""Finds a student's lab in another place than the one where a grader looks for it.

Git is asked for objects and names alone, as `labkit.base.git` does, and of a folder
the names are read: the clone may be a stranger's.
"""

import os
import posixpath
import re
import tempfile
import time
from collections.abc import Iterable, Iterator
from pathlib import Path

from labkit.base import git
from labkit.base.text import visible
from labkit.handin.handin import notebook_name
from labkit.lesson.day import Day
from labkit.lesson.week import NOTEBOOKS

BRANCHES, FILES = 20, 20_000  # the most that is searched
DEEP = 30  # folders in each other
SKIPPED = (".git", ".venv", "node_modules", "__pycache__", NOTEBOOKS)
SUBMODULE = "160000"  # mode of a repository inside a repository


def whereabouts(day: Day, clone: Path, counted: str = "") -> str:
    """Return a sentence on where a day's lab is; "" where it is nowhere.

    Args:
        day: from the kit's manifest.
        clone: the student's folder.
        counted: the commit that was looked at, "" where it was the folder.

    Raises:
        GitError: git is not there, or takes too long.
    """
    history = git.read_history(clone, [day.files["script"]])
    ways = (
        _in_a_commit_that_does_not_count(day, history, counted),
        _under_another_name(day, _files_below(clone)),
        _inside_a_submodule(day, clone, history),
        _on_a_branch(day, clone, history),
        _kept_out(day, clone, history),
        _without_a_commit(clone, history),
    )
    return next((sentence for way in ways for sentence in way), "")


def _in_a_commit_that_does_not_count(
    day: Day, history: git.History, counted: str
) -> Iterator[str]:
    """Yield that the last commit has the file, and the folder or an earlier has not."""
    name = day.files["script"]
    if name not in history.blobs:
        return
    if counted in ("", history.commit):
        yield f"Your last commit has it, the folder does not: git checkout -- {name}"
        return
    when = history.committed or 0
    dated = time.strftime("%Y-%m-%d", time.gmtime(when))
    ahead = ", which lies in the future: that computer's clock is wrong"
    yield (
        f"The last commit ({history.commit[: git.SHA]}) has it, but an earlier commit"
        f" counts. The last commit is dated {dated}{ahead * (when > time.time())}."
    )


def _files_below(clone: Path) -> list[str]:
    """Return the paths of a folder's files, from there, links not followed."""
    found: list[str] = []
    for folder, folders, names in os.walk(clone):
        inside = Path(folder).relative_to(clone)
        kept = [name for name in folders if name not in SKIPPED]
        folders[:] = sorted(kept) if len(inside.parts) < DEEP else []
        found += [(inside / name).as_posix() for name in sorted(names)]
        if len(found) > FILES:
            break
    return found


def _under_another_name(day: Day, paths: Iterable[str]) -> Iterator[str]:
    """Yield where a file of the lab's name is, or a notebook of the day."""
    wanted = day.files["script"]
    for path in paths:
        folder, name = posixpath.split(path)
        if name == day.script and posixpath.basename(folder) != "src":
            place = visible(path)
            yield f"There is a file of that name: {place}. Move it to {wanted}."
        stem, end = posixpath.splitext(name.lower())
        mine = re.fullmatch(rf"day{day.number}(_.*)?", stem)
        if end == ".ipynb" and mine and path != notebook_name(day):
            yield (
                f"There is a notebook: {visible(path)}. Move it to"
                f" {notebook_name(day)}, and the functions in it count."
            )


def _inside_a_submodule(day: Day, clone: Path, history: git.History) -> Iterator[str]:
    """Yield that a folder above the file is a repository of its own."""
    parts = day.files["script"].split("/")
    for folder in ("/".join(parts[:end]) for end in range(1, len(parts))):
        there = git.mode_of(clone, history.commit, folder) if history.commit else ""
        if there == SUBMODULE or (clone / folder / ".git").exists():
            yield (
                f"The folder {folder} is a git repository of its own (a submodule), so"
                " your commits do not hold its files. Remove the folder's .git, then:"
                f" git rm --cached {folder}; git add {folder}"
            )


def _on_a_branch(day: Day, clone: Path, history: git.History) -> Iterator[str]:
    """Yield which other branch has the file."""
    name = day.files["script"]
    if name in history.blobs:
        return
    where = f"the branch {visible(history.branch)}"
    if not history.branch:
        where = "a commit without a branch (a detached HEAD)"
    for branch in git.branches_of(clone)[:BRANCHES]:
        if git.files_of(clone, branch, name):
            short = visible(branch.removeprefix("refs/heads/"))
            short = short.removeprefix("refs/remotes/")
            yield (
                f"It is on the branch {short}, and this clone is at {where}."
                f" Bring it over: git merge {short}"
            )


def _kept_out(day: Day, clone: Path, history: git.History) -> Iterator[str]:
    """Yield which line of the student's .gitignore keeps the file out of commits.

    An empty repository of our own is asked, with the same .gitignore files.
    """
    name = day.files["script"]
    if not history.commit:
        return
    parents = [posixpath.dirname(name)]
    while parents[-1]:
        parents.append(posixpath.dirname(parents[-1]))
    lists = [posixpath.join(parent, ".gitignore") for parent in parents]
    with tempfile.TemporaryDirectory(prefix="robo47-ignored-") as folder:
        for path, (hash_, _) in git.files_of(clone, history.commit, *lists).items():
            copy = Path(folder) / path
            copy.parent.mkdir(parents=True, exist_ok=True)
            copy.write_bytes(git.blob(clone, hash_))
        copy = Path(folder) / name
        copy.parent.mkdir(parents=True, exist_ok=True)
        copy.touch()
        for command in (("init", "-q"), ("config", "core.excludesFile", os.devnull)):
            git.run(*command, folder=Path(folder), seconds=git.SECONDS)
        found = git.ignored_by(Path(folder), name)
    if found:
        yield (
            f"{found} keeps git from adding it. Delete that line, then"
            f" git add {name}, and commit."
        )


def _without_a_commit(clone: Path, history: git.History) -> Iterator[str]:
    """Yield that nothing was ever committed or pushed."""
    if (clone / ".git").exists() and history.readable and not history.commit:
        yield "This repository has no commit yet: commit your work, then push it."
