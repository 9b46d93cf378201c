"""The commit that a number was made at, read from git's own files.

Asking `git` costs milliseconds a row; these are two small reads.
"""

import os
from pathlib import Path

LENGTH = 7  # as `git rev-parse --short` prints for a repository of this size


def short_sha(folder: Path) -> str:
    """Return the short commit id that HEAD names, or "" outside a repository.

    Args:
        folder: the working tree's top folder: a clone or a linked worktree.
    """
    try:
        git = git_folder(str(folder))
        head = _read(git, "HEAD")
        if head.startswith("ref: "):
            head = _resolve(git, head[5:])
        return head[:LENGTH]
    except OSError:
        return ""


def git_folder(folder: str) -> str:
    """Return the git folder; in a worktree `.git` is a file that names it."""
    git = os.path.join(folder, ".git")
    if os.path.isdir(git):
        return git
    return os.path.join(folder, _read(folder, ".git").removeprefix("gitdir: "))


def _resolve(git: str, ref: str) -> str:
    """Return what a branch points at: its own file, else a line of packed-refs."""
    common = git
    if os.path.exists(os.path.join(git, "commondir")):  # a worktree shares branches
        common = os.path.join(git, _read(git, "commondir"))
    try:
        return _read(common, ref)
    except OSError:
        for line in _read(common, "packed-refs").splitlines():
            sha, _, name = line.partition(" ")
            if name == ref:
                return sha
        return ""  # no commit yet


def _read(folder: str, name: str) -> str:
    with open(os.path.join(folder, name), encoding="utf-8") as file:
        return file.read().strip()
