"""Reading the log line by line: what each holds, was repaired to hold, or why not.

One line is one row, so a quote that is never closed costs its own line only.
"""

import csv
import os
import re
from collections.abc import Iterator
from pathlib import Path
from typing import BinaryIO, NamedTuple

from labkit.log import header
from labkit.log.logfile import CUT
from labkit.log.rows import COLUMNS, Row, decode, is_open_quote
from robo47.errors import Robo47Error
from robo47.paths import shown

WIDTH = len(COLUMNS)
_DATE = re.compile(r"\d{4}-\d\d-\d\d")


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
    with _opened(Path(path)) as file:
        yield from scan_file(file, path)


def scan_file(file: BinaryIO, path: str | os.PathLike[str]) -> Iterator[Line]:
    """Yield the lines of a log that is open already, as `scan` does.

    Args:
        file: at its start.
        path: the log's name; lines that were noted as cut stand beside it.
    """
    chosen = Path(path)
    head = file.read(header.LONGEST)
    if head in (b"", header.BOM):
        return
    if not header.line_end(head):
        raise Robo47Error(header.problem(chosen))
    file.seek(0)
    file.readline()
    cut = _known_cuts(chosen)
    for number, raw in enumerate(file, 2):
        if raw.strip(b"\0 \t\r\n"):
            yield _line(number, raw, cut)


def _opened(path: Path) -> BinaryIO:
    try:
        if path.exists() and not path.is_file():
            raise OSError("it is no regular file")  # a pipe would wait for ever
        return open(path, "rb")
    except FileNotFoundError:
        raise Robo47Error(
            f"{shown(path)} does not exist. `make day1` writes the first row, or bring"
            " it back: git checkout metrics/metrics.csv"
        ) from None
    except OSError as error:
        raise Robo47Error(
            f"{shown(path)} cannot be read: {error.strerror or error}. Fix that."
        ) from None


def _line(number: int, raw: bytes, cut: set[str]) -> Line:
    text, problem = _decoded(raw)
    row, fault = _row_of(text)
    problem = problem or fault
    if row is not None and not problem and text in cut:
        problem = "it had no line end when the next row came, so it may be cut"
    return Line(number, text, row, problem, len(raw))


def _decoded(raw: bytes) -> tuple[str, str]:
    """Return a line's text, and what had to be repaired to read it."""
    problem = "" if raw.endswith(b"\n") else "it has no line end, so it may be cut"
    raw = raw.rstrip(b"\r\n")
    if b"\0" in raw:
        raw = raw.replace(b"\0", b"").rstrip(b"\r\n")
        problem = "it has NUL bytes (PowerShell's >>, or a power cut)"
    try:
        text = raw.decode()
    except UnicodeDecodeError:
        text = raw.decode("cp1252", "replace")
        problem = "it is not UTF-8; read as Windows-1252"
    return text.replace("\r", " "), problem


def _row_of(text: str) -> tuple[Row | None, str]:
    """Return a line's row, or None, and what is wrong with the line."""
    try:
        cells, problem = _cells(text)
        if len(cells) != WIDTH:
            cells, problem = _thirteen(cells)
        return decode(cells), problem
    except ValueError as error:
        return None, str(error)


def _cells(text: str) -> tuple[list[str], str]:
    if '"' not in text:
        return text.split(","), ""
    problem = ""
    if is_open_quote(text):
        text, problem = text + '"', "it has a quote that is never closed"
    try:
        cells = next(csv.reader([text], strict=True))
    except csv.Error:
        raise ValueError("its quotes do not match") from None
    if len(cells) == 1 and "," in cells[0]:  # cmd.exe's echo keeps the quotes
        return cells[0].split(","), "the whole line is in quotes"
    return cells, problem


def _thirteen(cells: list[str]) -> tuple[list[str], str]:
    """Return a row's cells from a few too many; too few may hide a cut number."""
    if len(cells) < WIDTH:
        raise ValueError(f"{len(cells)} columns where {WIDTH} belong (cut, or no row)")
    if any(_DATE.fullmatch(cell) for cell in cells[2:]):
        raise ValueError(f"{len(cells)} columns where {WIDTH} belong (two rows in one)")
    notes = ",".join(cells[WIDTH - 1 :])
    return [*cells[: WIDTH - 1], notes], "it has commas outside quotes in its notes"


def _known_cuts(path: Path) -> set[str]:
    try:
        text = Path(str(path) + CUT).read_text("utf-8", "replace")
    except OSError:
        return set()
    return set(text.split("\n"))
