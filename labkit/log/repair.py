"""Looking after the log: find what is wrong, repair a copy, bring kept rows back."""

import os
import subprocess
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

from labkit.log import header
from labkit.log.logfile import (
    UNSAVED,
    CannotAppendError,
    append,
    locked,
    note_repair,
    read_at,
)
from labkit.log.rows import COLUMNS, encode
from labkit.log.scan import Line, scan
from robo47.errors import Robo47Error
from robo47.paths import shown


class Repaired(NamedTuple):
    """What `repair` wrote: the copy, the unreadable rest, and the lines of each.

    `header` says what was wrong with the first line, or "".
    """

    copy: Path
    rest: Path | None
    rows: int
    repaired: list[Line]
    unread: list[Line]
    header: str


def header_problem(path: Path) -> str:
    """Return what is wrong with the log's first line and what to do, or ""."""
    head = _wrong_head(path)
    return header.problem(head, path) if head else ""


def unsaved_rows(path: Path) -> int:
    """Return how many refused rows wait beside the log."""
    try:
        return Path(f"{path}{UNSAVED}").read_bytes().count(b"\n")
    except OSError:
        return 0


def repair(path: Path, lines: Iterator[Line] | None = None) -> Repaired:
    """Write a repaired copy of the log beside it; no file is ever overwritten.

    Args:
        path: the log, in whatever state.
        lines: its lines, if the caller wants to watch them go by.

    Returns:
        The copy, and which lines were repaired or left out; what was left out is
        kept word for word in a text file beside the copy.

    Raises:
        Robo47Error: the log cannot be read, its header leaves in doubt which column
            is which, or its folder cannot be written.
    """
    rows, repaired, unread = [header.LINE], [], []
    for line in lines or scan(path, as_is=True):
        if line.row is None:
            unread.append(line)
            continue
        rows.append(encode(line.row))
        if line.problem:
            repaired.append(line)
            note_repair(path, rows[-1])
    copy = _write_new(path, ".csv", rows)
    rest = _write_new(path, ".rest.txt", [x.text for x in unread]) if unread else None
    head = _wrong_head(path)
    wrong = _header_repaired(head) if head else ""
    return Repaired(copy, rest, len(rows) - 1, repaired, unread, wrong)


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
        with locked(str(kept)) as fd:
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


def _wrong_head(path: Path) -> bytes:
    """Return the log's first bytes if its header is wrong, else none."""
    with open(path, "rb") as file:
        head = file.read(header.LONGEST)
    return b"" if head == header.BOM or header.line_end(head) else head


def _header_repaired(head: bytes) -> str:
    names = header.layout(head).names
    others = [name for name in names if name and name not in COLUMNS]
    moved = f"; {', '.join(others)} moved to the notes" if others else ""
    return header.fault(head) + moved


def _write_new(path: Path, suffix: str, lines: list[str]) -> Path:
    """Write a file whose name nothing has yet: metrics.repaired.csv, -2, -3 ..."""
    text = "".join(line + "\n" for line in lines)
    for number in range(1, 1000):
        again = f"-{number}" if number > 1 else ""
        copy = path.with_name(f"{path.stem}.repaired{again}{suffix}")
        try:
            with open(copy, "x", encoding="utf-8", newline="\n") as file:
                file.write(text)
            return copy
        except FileExistsError:
            continue
        except OSError as error:
            why = error.strerror or error
            raise Robo47Error(
                f"cannot write {shown(copy)}: {why}. Free space, or make the folder"
                " writable."
            ) from None
    raise Robo47Error(f"1,000 repaired copies are beside {shown(path)}: remove some.")
