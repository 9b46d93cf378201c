"""A log that a spreadsheet saved in another form, written again as the log it was.

Only what is certain is converted: every column keeps its own name, so two columns can
never be exchanged. What is not certain (a missing column, marks of a merge, a row of
another length) is an error, and nothing has changed then.
"""

import csv
import io
from collections.abc import Iterator
from itertools import count
from pathlib import Path

from labkit.base import store
from labkit.log.rows import (
    COLUMNS,
    HEADER,
    Row,
    decode,
    encode,
    separator,
    unreadable,
)
from robo47.errors import Robo47Error
from robo47.paths import shown


def convert(path: Path) -> tuple[int, Path]:
    """Write a log in its own form, and keep the old file beside it.

    Args:
        path: the log, with another separator, quotes, capitals, order of columns,
            further columns, line end or encoding.

    Returns:
        The number of rows, and the name of the old file.

    Raises:
        Robo47Error: the file holds no log, or a row that does not fit; nothing changed.
    """
    try:
        old = path.read_bytes()
    except OSError as error:
        raise Robo47Error(f"{shown(path)} cannot be read: {error.strerror}.") from None
    if why := unreadable(old):
        raise Robo47Error(f"{shown(path)}: not converted. {why}")
    rows = list(_rows(_text(path, old), path))
    kept = next(
        name
        for n in count(1)
        if not (name := path.with_name(f"{path.stem}.before-convert-{n}.csv")).exists()
    )
    store.replace(kept, old, sync=True)
    lines = [HEADER, *(encode(row) for row in rows)]
    store.replace(path, ("\n".join(lines) + "\n").encode(), sync=True)
    return len(rows), kept


def _text(path: Path, data: bytes) -> str:
    """Return a file's text, whichever of UTF-8 and UTF-16 it is in."""
    utf_16 = data[:2] in (b"\xff\xfe", b"\xfe\xff")
    try:
        text = data.decode("utf-16" if utf_16 else "utf-8").lstrip("\ufeff")
    except UnicodeDecodeError:
        raise Robo47Error(
            f"{shown(path)}: not converted. It is neither UTF-8 nor UTF-16: save it as"
            " CSV UTF-8 first."
        ) from None
    return text.replace("\r\n", "\n").replace("\r", "\n").replace("\0", "")


def _rows(text: str, path: Path) -> Iterator[Row]:
    """Yield the rows of a log in another form, each cell under its column's name."""
    if text[:4].lower() == "sep=":  # a line that Excel writes above the header
        text = text.partition("\n")[2]
    first = text.partition("\n")[0]
    mark = separator(first)
    table = csv.reader(io.StringIO(text), delimiter=mark)
    names = [name.strip(" '\"").lower() for name in next(table, [])]
    twice = sorted({name for name in COLUMNS if names.count(name) > 1})
    missing = [name for name in COLUMNS if name not in names]
    if missing or twice:
        says = "is missing" if missing else "stands twice"
        raise Robo47Error(
            f"{shown(path)}: not converted. The column {', '.join(missing or twice)}"
            f" {says}. All are: {HEADER}"
        )
    places = [names.index(name) for name in COLUMNS]
    for cells in table:
        if not any(cell.strip() for cell in cells):
            continue
        try:
            if len(cells) != len(names):
                raise ValueError(f"it has {len(cells)} cells, and line 1 {len(names)}")
            row = dict(zip(COLUMNS, [cells[i] for i in places], strict=True))
            if mark != ",":  # a comma that separates no cells may be a decimal sign
                row["value"] = row["value"].replace(",", ".")
            yield decode(list(row.values()))
        except ValueError as error:
            raise Robo47Error(
                f"{shown(path)}: not converted. Line {table.line_num}: {error}. Correct"
                " it in an editor, then convert again."
            ) from None
