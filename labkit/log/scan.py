"""Reading the log line by line: the row that each holds, or why it holds none.

One line is one row, so a quote that is never closed costs its own line only.
"""

import contextlib
import csv
import os
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import BinaryIO, NamedTuple

from labkit.base import git
from labkit.base.text import count
from labkit.log.logfile import CUT
from labkit.log.rows import BOM, COLUMNS, HEAD, Row, decode, line_end, wrong_header
from robo47.errors import Robo47Error
from robo47.paths import shown

WIDTH = len(COLUMNS)


class Line(NamedTuple):
    """One line: `row` is None if unreadable; `problem` is "" if nothing is wrong."""

    number: int
    text: str
    row: Row | None
    problem: str
    size: int  # bytes in the file, for a progress bar


def scan(path: str | os.PathLike[str]) -> Iterator[Line]:
    """Yield every line of the log that is not blank, the header left out.

    Args:
        path: the CSV.

    Raises:
        Robo47Error: no file, or a first line that is not the header.
    """
    name = Path(path)
    try:
        if name.exists() and not name.is_file():
            raise OSError("it is no regular file")  # a pipe would wait for ever
        file = name.open("rb")
    except FileNotFoundError:
        raise Robo47Error(
            f"{shown(name)} does not exist. `make day1` writes the first row, or"
            " bring it back: git checkout metrics/metrics.csv"
        ) from None
    except OSError as error:
        why = error.strerror or error
        raise Robo47Error(f"{shown(name)} cannot be read: {why}. Fix that.") from None
    with file:
        yield from scan_file(file, path)


def watched(path: Path) -> Iterator[Line]:
    """Yield what `scan` yields, and show what takes over half a second to read."""
    from tqdm import tqdm

    size = os.path.getsize(path) if path.exists() else 0
    with tqdm(
        total=size,
        unit="B",
        unit_scale=True,
        desc="reading",
        delay=0.5,
        leave=False,
        disable=None,
    ) as bar:
        for line in scan(path):
            bar.update(line.size)
            yield line


def scan_file(file: BinaryIO, path: str | os.PathLike[str]) -> Iterator[Line]:
    """Yield the lines of a log that is open already, as `scan` does.

    Args:
        file: at its start.
        path: the log's name; lines that were noted as cut stand beside it.
    """
    chosen = Path(path)
    head = file.read(HEAD)
    if head in (b"", BOM):
        return
    if not line_end(head):
        raise Robo47Error(wrong_header(chosen))
    file.seek(0)
    file.readline()
    cut: set[str] = set()  # lines that were noted as such
    with contextlib.suppress(OSError):
        cut.update(Path(f"{path}{CUT}").read_text("utf-8", "replace").split("\n"))
    for number, raw in enumerate(file, 2):
        if raw.strip(b"\0 \t\r\n"):
            yield _line(number, raw, cut)


def came_back(path: Path) -> set[str]:
    """Return lines that a commit took out and a merge brought back.

    A union merge keeps both sides' lines: a row that one branch deleted or edited
    returns as it was. Only git's history shows that.

    Returns:
        Those lines. None outside git, or where git is not installed.
    """
    how = ("--no-merges", "--format=", "--patch", "--unified=0", "--no-color")
    asked = ("log", *how, "--", path.name)
    where = path.resolve().parent
    try:
        history = git.run(*asked, folder=where, seconds=git.SECONDS).stdout
        now = set(path.read_bytes().decode("utf-8", "replace").split("\n"))
    except (OSError, git.GitError):
        return set()
    balance: Counter[str] = Counter()
    for line in history.split("\n"):
        if line.startswith(("+", "-")) and not line.startswith(("+++ ", "--- ")):
            balance[line[1:]] += 1 if line[0] == "+" else -1
    return {line for line, n in balance.items() if n <= 0 and line.strip()} & now


def _line(number: int, raw: bytes, cut: set[str]) -> Line:
    problem = "" if raw.endswith(b"\n") else "it has no line end, so it may be cut"
    row = None
    bare = raw.rstrip(b"\r\n")
    text = bare.decode("utf-8", "replace").replace("\r", " ")
    try:
        row = decode(_cells(bare))
    except ValueError as error:
        problem = problem or str(error)
    if row is not None and not problem and text in cut:
        problem = "it had no line end when the next row came, so it may be cut"
    return Line(number, text.replace("\0", ""), row, problem, len(raw))


def _cells(raw: bytes) -> list[str]:
    """Return the cells of a line; ValueError says why it holds no row."""
    if b"\0" in raw:
        raise ValueError("it has NUL bytes (PowerShell's >>, or a power cut)")
    try:
        text = raw.decode().replace("\r", " ")
        cells = (
            next(csv.reader([text], strict=True)) if '"' in text else text.split(",")
        )
    except UnicodeDecodeError:
        raise ValueError("it is not UTF-8; save the log as UTF-8") from None
    except csv.Error:
        raise ValueError("its quotes do not match") from None
    if len(cells) != WIDTH:
        few = "cut, or no row"
        why = few if len(cells) < WIDTH else "two rows in one, or commas without quotes"
        raise ValueError(f"{count(len(cells), 'column')} where {WIDTH} belong ({why})")
    return cells
