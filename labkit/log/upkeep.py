"""Upkeep of the log: rows that wait beside it, and rows that a merge brought back."""

import os
import subprocess
from collections import Counter
from pathlib import Path

from labkit.log.logfile import UNSAVED, CannotAppendError, append, locked, read_at
from robo47.errors import Robo47Error
from robo47.paths import shown


def unsaved_rows(path: Path) -> int:
    """Return how many refused rows wait beside the log."""
    try:
        return Path(f"{path}{UNSAVED}").read_bytes().count(b"\n")
    except OSError:
        return 0


def restore(path: Path) -> int:
    """Append the rows kept in `<log>.unsaved` and empty it; return how many.

    Raises:
        Robo47Error: the log still cannot take them; they stay where they are.
    """
    count = unsaved_rows(path)
    if not count:
        return 0
    kept = Path(f"{path}{UNSAVED}")
    try:
        with locked(kept) as fd:
            text = read_at(fd, 0, os.fstat(fd).st_size).decode()
            append(path, text.removesuffix("\n"), sync=True)
            os.ftruncate(fd, 0)
            if os.name != "nt":  # there an open file cannot be removed
                kept.unlink()
    except (CannotAppendError, OSError) as error:
        raise Robo47Error(f"{error}\n  the rows are still in {shown(kept)}") from None
    return text.count("\n")


def came_back(path: Path) -> set[str]:
    """Return lines that a commit took out and a merge brought back.

    A union merge keeps both sides' lines: a row that one branch deleted or edited
    returns as it was. Only git's history shows that.

    Returns:
        Those lines. None outside git, or where git is not installed.
    """
    command = ["git", "-C", str(path.resolve().parent), "log", "--no-merges"]
    command += ["--format=", "--patch", "--unified=0", "--no-color", "--", path.name]
    try:
        done = subprocess.run(command, capture_output=True, check=True)
        now = set(path.read_bytes().decode("utf-8", "replace").split("\n"))
    except (OSError, subprocess.CalledProcessError):
        return set()
    balance: Counter[str] = Counter()
    for line in done.stdout.decode("utf-8", "replace").split("\n"):
        if line.startswith("+") and not line.startswith("+++ "):
            balance[line[1:]] += 1
        elif line.startswith("-") and not line.startswith("--- "):
            balance[line[1:]] -= 1
    return {line for line, n in balance.items() if n <= 0 and line.strip()} & now
