"""Reading the log line by line: what each holds, was repaired to hold, or why not.

One line is one row, so a quote that is never closed costs its own line only.
"""

import csv
import io
import os
import re
from collections.abc import Iterator
from pathlib import Path
from typing import BinaryIO, NamedTuple

from labkit.log import header
from labkit.log.header import Layout
from labkit.log.logfile import REPAIRS
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


def scan(path: str | os.PathLike[str], as_is: bool = False) -> Iterator[Line]:
    """Yield every line of the log that is not blank, the header left out.

    Args:
        path: the CSV.
        as_is: read also a file whose header is wrong, as well as can be told.

    Raises:
        Robo47Error: no file; a first line that is not the header, unless `as_is` and
            it can be told which column is which.
    """
    with _opened(Path(path)) as file:
        yield from scan_file(file, path, as_is)


def scan_file(
    file: BinaryIO, path: str | os.PathLike[str], as_is: bool = False
) -> Iterator[Line]:
    """Yield the lines of a log that is open already, as `scan` does.

    Args:
        file: at its start.
        path: the log's name; lines that were noted as repaired stand beside it.
        as_is: as for `scan`.
    """
    chosen = Path(path)
    head = file.read(header.LONGEST)
    if head in (b"", header.BOM):
        return
    plan = Layout() if header.line_end(head) else header.layout(head)
    if not header.line_end(head) and not (as_is and plan.is_clear):
        raise Robo47Error(f"{shown(chosen)}: {header.problem(head, chosen)}")
    file.seek(0)
    lines: BinaryIO = io.BytesIO(_from_utf16(file)) if plan.utf16 else file
    yield from _lines(lines, plan, _known_repairs(chosen))


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


def _lines(file: BinaryIO, plan: Layout, repaired: set[str]) -> Iterator[Line]:
    header_due = plan.has_header
    for number, raw in enumerate(file, 1):
        if number == 1:
            raw = raw.removeprefix(header.BOM)
        if not raw.strip(b"\0 \t\r\n"):
            continue
        if header_due:
            header_due = False
            continue
        text, problem = _decoded(raw)
        row, fault = _row_of(text, plan)
        problem = problem or fault
        if row is not None and not problem and text in repaired:
            problem = "it had no line end when the next row came, so it may be cut"
        yield Line(number, text, row, problem, len(raw))


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


def _row_of(text: str, plan: Layout) -> tuple[Row | None, str]:
    """Return a line's row, or None, and what is wrong with the line."""
    try:
        cells, problem = _cells(text, plan.delimiter)
        if plan.names != COLUMNS or plan.delimiter != ",":
            cells = _in_order(cells, plan)
        elif len(cells) != WIDTH:
            cells, problem = _thirteen(cells)
        return decode(cells), problem
    except ValueError as error:
        return None, str(error)


def _cells(text: str, delimiter: str) -> tuple[list[str], str]:
    if '"' not in text:
        return text.split(delimiter), ""
    problem = ""
    if is_open_quote(text, delimiter):
        text, problem = text + '"', "it has a quote that is never closed"
    try:
        cells = next(csv.reader([text], delimiter=delimiter, strict=True))
    except csv.Error:
        raise ValueError("its quotes do not match") from None
    if len(cells) == 1 and delimiter in cells[0]:  # cmd.exe's echo keeps the quotes
        return cells[0].split(delimiter), "the whole line is in quotes"
    return cells, problem


def _thirteen(cells: list[str]) -> tuple[list[str], str]:
    """Return a row's cells from a few too many; too few may hide a cut number."""
    if len(cells) < WIDTH:
        raise ValueError(f"{len(cells)} columns where {WIDTH} belong (cut, or no row)")
    if any(_DATE.fullmatch(cell) for cell in cells[2:]):
        raise ValueError(f"{len(cells)} columns where {WIDTH} belong (two rows in one)")
    notes = ",".join(cells[WIDTH - 1 :])
    return [*cells[: WIDTH - 1], notes], "it has commas outside quotes in its notes"


def _in_order(cells: list[str], plan: Layout) -> list[str]:
    """Return the cells of a file with other columns, in the log's own order."""
    names = plan.names
    if len(cells) == WIDTH and names == tuple(x for x in COLUMNS if x in names):
        names = COLUMNS  # the header lost a name, and this row no cell
    if len(cells) != len(names):
        raise ValueError(f"{len(cells)} columns where its header has {len(names)}")
    pairs = list(zip(names, cells, strict=True))
    row = dict(pairs)
    if plan.delimiter == ";":  # such spreadsheets write 0,5 for 0.5
        row["value"] = row.get("value", "").replace(",", ".")
    extra = [f"{k}={v}" if k else v for k, v in pairs if k not in COLUMNS and v]
    row["notes"] = " ".join([row.get("notes", ""), *extra]).strip()
    return [row.get(name, "") for name in COLUMNS]


def _from_utf16(file: BinaryIO) -> bytes:
    return file.read().decode("utf-16", "replace").encode()


def _known_repairs(path: Path) -> set[str]:
    try:
        text = Path(str(path) + REPAIRS).read_text("utf-8", "replace")
    except OSError:
        return set()
    return set(text.split("\n"))
