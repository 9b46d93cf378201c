"""Git queries of an update, and the worktree beside the clone in which it works."""

import contextlib
import os
import shutil
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from labkit.base import git, store
from robo47.errors import Robo47Error
from robo47.paths import ROOT

SECONDS = 300.0
PREFIX = "update-"  # the first part of a temporary folder's name in `.robo47/`
NO_HOOKS = ("-c", f"core.hooksPath={os.devnull}")  # they see no checkout of ours
NOBODY = ("-c", "user.name=robo47", "-c", "user.email=robo47@localhost")


def ask(
    *arguments: str,
    at: Path = ROOT,
    may_fail: bool = False,
    index: Path | None = None,
) -> str:
    """Return what git prints.

    Args:
        arguments: after `git`.
        at: the folder.
        may_fail: return "" where git fails.
        index: instead of the clone's own.

    Raises:
        Robo47Error: git fails; what it says, with the files that it names.
    """
    more: dict[str, Any] = {"GIT_INDEX_FILE": str(index)} if index else {}
    more |= {"seconds": SECONDS, "largest": git.LARGEST_GIT}
    try:
        done = git.run(*NO_HOOKS, *arguments, folder=at, **more)
    except git.GitError as error:
        raise Robo47Error(f"{error}") from None
    if done.returncode == 0:
        return str(done.stdout.rstrip("\n"))
    if may_fail:
        return ""
    lines = " ".join(done.stderr.split())[:300].rstrip(".")
    raise Robo47Error(lines or f"git {arguments[0]} ended with {done.returncode}")


def as_whom(at: Path) -> tuple[str, ...]:
    """Return options of git's: a student without a name in git has one for this."""
    return () if ask("config", "user.name", at=at, may_fail=True) else NOBODY


def commit(message: str, at: Path) -> None:
    """Commit what is staged."""
    how = ("commit", "-q", "--no-gpg-sign", "-m", message)
    ask(*as_whom(at), *how, at=at)


@contextlib.contextmanager
def _folder() -> Iterator[Path]:
    """Yield a folder beside the clone's files, under a name that no run before had.

    A git that outlives a killed run for a moment has its own.
    """
    memory = store.path_of("")
    memory.mkdir(exist_ok=True)
    with tempfile.TemporaryDirectory(prefix=PREFIX, dir=memory) as place:
        yield Path(place)


@contextlib.contextmanager
def own_index() -> Iterator[Path]:
    """Yield where an index may be, besides the clone's own; it goes with the block."""
    with _folder() as folder:
        yield folder / "index"


def look_again(index: Path) -> None:
    """Make a copied index see the files that git was told to overlook.

    The marks are those of `update-index --assume-unchanged` and `--skip-worktree`. A
    file that a sparse checkout leaves out is not there and keeps its mark.
    """
    listed = ask("ls-files", "-vz", index=index).split("\0")[:-1]
    marked = [line[2:] for line in listed if line[0] == "S" or line[0].islower()]
    there = [name for name in marked if os.path.lexists(ROOT / name)]
    for start in range(0, len(there), 200):  # a command line has an end
        some = there[start : start + 200]
        for flag in ("--no-assume-unchanged", "--no-skip-worktree"):
            ask("update-index", flag, "--", *some, index=index)


@contextlib.contextmanager
def worktree_at(head: str) -> Iterator[Path]:
    """Yield a worktree at a commit; it goes with the block."""
    with _folder() as place:
        try:
            ask("worktree", "add", "-q", "--detach", str(place), head)
            yield place
        finally:
            with contextlib.suppress(Robo47Error):  # away, or it goes at the next run
                remove(place)


def remove(place: Path) -> None:
    """Take a worktree away, and what git remembers of it."""
    ask("worktree", "remove", "-f", "-f", str(place), may_fail=True)
    shutil.rmtree(place, ignore_errors=True)
    ask("worktree", "prune")


def sweep() -> None:
    """Take away what runs left behind that were killed."""
    for place in store.path_of("").glob(f"{PREFIX}*/"):
        remove(place)
