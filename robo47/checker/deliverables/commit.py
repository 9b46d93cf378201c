"""The day's files in git."""

import os
import subprocess
from pathlib import Path

from robo47.checker.deliverables.item import Item
from robo47.lesson.day import Day

SECONDS = 10
# The clone may be a stranger's: run nothing that its configuration names.
_GIT = ["git", "--no-optional-locks", "-c", "core.fsmonitor=false"]
_GIT += ["-c", f"core.hooksPath={os.devnull}", "-c", "core.quotePath=false"]


def check_commit(day: Day, root: Path) -> Item:
    """Check that the day's files are committed as they are now.

    Args:
        day: from the kit's manifest.
        root: the student's clone.
    """
    wanted = wanted_files(day)
    tracked = _git(root, "ls-files", "-z", "--", *wanted)
    changed = _git(
        root, "status", "--porcelain=v1", "-z", "-uall", "--no-renames", "--", *wanted
    )
    if tracked is None or changed is None:
        return no_repository()
    dirty = {entry[3:] for entry in changed if entry}
    return as_item(day, [f for f in wanted if f in dirty or f not in tracked])


def no_repository() -> Item:
    """Return how the commit stands where git finds no repository."""
    return Item("commit", "todo", "This folder is no git repository: git init")


def wanted_files(day: Day) -> list[str]:
    """Return the files to commit: script, worksheet, figure and log, from the top."""
    week = day.folder.name
    own = (f"work/{day.script}", day.worksheet, day.figure)
    return [*(f"{week}/{name}" for name in own), "metrics/metrics.csv"]


def as_item(day: Day, left: list[str]) -> Item:
    """Return how the commit stands.

    Args:
        day: from the kit's manifest.
        left: which of the wanted files are not committed as they are now.
    """
    if not left:
        return Item("commit")
    says = (
        f"Not committed as they are now: {', '.join(left)}.\n"
        f'git add {day.folder.name} metrics && git commit -m "Day {day.number}"'
    )
    return Item("commit", "todo", says)


def _git(root: Path, *arguments: str) -> list[str] | None:
    """Return what git lists, or None where there is no git or no repository."""
    environment = {k: v for k, v in os.environ.items() if not k.startswith("GIT_")}
    try:
        done = subprocess.run(
            [*_GIT, "-C", str(root), *arguments],
            capture_output=True,
            encoding="utf-8",
            errors="replace",
            env={**environment, "GIT_TERMINAL_PROMPT": "0"},
            timeout=SECONDS,
            check=False,
        )
    except (OSError, subprocess.TimeoutExpired):
        return None
    return done.stdout.split("\0") if done.returncode == 0 else None
