"""A clone of the last commit, set up from nothing, as somebody else would have it."""

import os
import sys
from collections.abc import Callable
from pathlib import Path

from labkit.base import git, processes
from robo47.errors import Robo47Error
from robo47.paths import ROOT, menagerie_root

GIT_SECONDS = 120.0
# These variables would lead the clone's Python back to this folder.
_OURS = ("PYTHONPATH", "VIRTUAL_ENV", "ROBO47_HANDED_ON", "ROBO47_METRICS")


def head_of(root: Path = ROOT) -> str:
    """Return the hash of the last commit.

    Raises:
        Robo47Error: there is none, or no git.
    """
    return _git("rev-parse", "--verify", "HEAD", folder=root).strip()


def clone_commit(sha: str, into: Path, root: Path = ROOT) -> None:
    """Clone a commit: nothing comes along that is not in it.

    Args:
        sha: of the commit.
        into: a folder that is not there yet.
        root: the clone to clone.

    Raises:
        Robo47Error: git cannot; says why in git's words.
    """
    _git("clone", "--quiet", "--no-checkout", str(root), str(into), folder=into.parent)
    _git("-c", "advice.detachedHead=false", "checkout", "--quiet", sha, folder=into)


def set_up(
    root: Path, say: Callable[[str], None], *, anew: bool = True
) -> tuple[str, dict[str, str]]:
    """Make a clone ready to run: its Python, and the variables that it runs with.

    The robot that is on this machine serves it too.

    Args:
        root: of the clone.
        say: is told what goes on, a line at a time.
        anew: make it an environment of its own; else this Python's packages serve.

    Raises:
        Robo47Error: it cannot be set up; says what the set-up said.
    """
    environment = {k: v for k, v in os.environ.items() if k not in _OURS}
    robot = menagerie_root()
    if robot.is_dir():
        environment["MENAGERIE_ROOT"] = str(robot.absolute())
    if not anew:
        environment["PYTHONPATH"] = str(root)
        return sys.executable, environment
    setup = [sys.executable, "scripts/setup_env.py"]
    # Without it Python keeps the lines of a pipe to itself until it ends.
    told = environment | {"PYTHONUNBUFFERED": "1"}
    code, printed = processes.run_and_tell(setup, say, env=told, cwd=root)
    if code != 0:
        says = " ".join(printed.split())[-400:]
        raise Robo47Error(f"the clone could not be set up: {says}")
    python = str(root / ".venv" / processes.IN_VENV)
    if not robot.is_dir():  # the embedded twin serves where there is no network
        fetch = [python, "scripts/fetch_menagerie.py", "--daily"]
        processes.run_and_tell(fetch, say, env=told, cwd=root)
    return python, environment


def uncommitted(root: Path = ROOT) -> dict[str, str]:
    """Return what the last commit lacks, by path: "not committed" or "changed since".

    Args:
        root: the clone.
    """
    listed = _git("status", "--porcelain", "--no-renames", "-z", "-uall", folder=root)
    found = {}
    for entry in filter(None, listed.split("\0")):
        code = entry[:2]
        path = entry[3:]
        new = code == "??" or "A" in code
        found[path] = "not committed" if new else "changed since the commit"
    return found


def ignored_by(path: str, root: Path = ROOT) -> str:
    """Return the line that makes git ignore a file, ".gitignore, line 3", or ""."""
    try:
        found = _git("check-ignore", "-v", "--", path, folder=root)
    except Robo47Error:  # git says no with its exit code
        return ""
    source, line, *_ = found.split(":")
    return f"{source}, line {line}"


def _git(*arguments: str, folder: Path) -> str:
    try:
        done = git.run(*arguments, folder=folder, seconds=GIT_SECONDS)
    except git.GitError as error:
        raise Robo47Error(f"{error}.") from None
    if done.returncode != 0:
        says = " ".join(done.stderr.split())[-300:] or "no"
        raise Robo47Error(f"git {arguments[0]}: {says}")
    return done.stdout
