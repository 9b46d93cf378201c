"""The course's lab notebook: one plain CSV that loses no row.

`append_row` adds a row with one write under a lock, `append_rows` several;
`read_rows` gives the rows back. `metrics/README.md` is the schema. Inside, one job
each: `rows` (a row and its line, the header), `logfile` (the append, and rows that
wait), `scan` (reading, line by line; lines that a merge brought back).
"""

import os
import time
import warnings
from collections.abc import Iterable, Mapping
from functools import lru_cache
from pathlib import Path

from labkit.base.git import short_sha
from labkit.base.text import count
from labkit.log.logfile import append_or_keep, command
from labkit.log.rows import COLUMNS, Row, checked_row, encode
from labkit.log.scan import scan
from robo47.errors import Robo47Error
from robo47.paths import HOME, METRICS_CSV, ROOT, shown

__all__ = ["COLUMNS", "append_row", "append_rows", "read_rows"]

StrPath = str | os.PathLike[str]


def append_row(
    path: StrPath | None = None,
    *,
    sync: bool = False,
    allow_nonfinite: bool = False,
    **fields: object,
) -> Row:
    """Add one row to the log and return it as it will be read back.

    Args:
        path: the CSV; default `metrics/metrics.csv`. Made, with its header, if absent.
        sync: force the row to the disk before returning (about 0.2 ms on an SSD).
        allow_nonfinite: record a NaN or an infinity instead of refusing it.
        fields: values by column name; see COLUMNS. `date` (today) and `git_sha`
            (HEAD of the kit's clone, "" outside git) are filled in when not given.

    Returns:
        Every column: int for day, seed, n_trials and n_failures, float for value
        (None where empty), str for the rest.

    Raises:
        Robo47Error: an unknown field, a value its column cannot hold, or a file
            that cannot take the row; then the message carries the row's text.
    """
    row, faults = checked_row(_filled(fields), allow_nonfinite)
    if faults:
        raise Robo47Error(f"not recorded: {'; '.join(faults)}.")
    append_or_keep(_file(path), encode(row), sync)
    return row


def append_rows(
    rows: Iterable[Mapping[str, object]],
    path: StrPath | None = None,
    *,
    sync: bool = False,
    allow_nonfinite: bool = False,
) -> list[Row]:
    """Add several rows in one write: all of them or none; return them.

    Args:
        rows: each the fields of one row, as for `append_row`; likewise the rest.

    Raises:
        Robo47Error: a row is wrong, which is said of each such row, and none is
            recorded; or the file cannot take them, and the message carries them all.
    """
    added, faults = [], []
    for number, fields in enumerate(rows, 1):
        row, wrong = checked_row(_filled(fields), allow_nonfinite)
        added.append(row)
        if wrong:
            faults.append(f"row {number}: {'; '.join(wrong)}")
    if faults:
        raise Robo47Error(f"no row is recorded: {'. '.join(faults)}.")
    if added:
        text = "\n".join(encode(row) for row in added)
        append_or_keep(_file(path), text, sync)
    return added


def read_rows(path: StrPath | None = None) -> list[Row]:
    """Return the log's rows, oldest first, as `append_row` returned them.

    Args:
        path: the CSV; default `metrics/metrics.csv`.

    Returns:
        One dict per readable line. Lines that cannot be read are left out, with
        one warning that counts them.

    Raises:
        Robo47Error: no file, or a first line that is not the log's header.
    """
    chosen = METRICS_CSV if path is None else Path(path)
    rows, unread = [], []
    for line in scan(chosen):
        if line.row is None:
            unread.append(line)
        else:
            rows.append(line.row)
    if unread:
        warnings.warn(
            f"{shown(chosen)}: {count(len(unread), 'line')} could not be read; the"
            f" first is line {unread[0].number}: {unread[0].problem}."
            f" See them all: {command('--check', chosen)}",
            stacklevel=2,
        )
    return rows


def _filled(fields: Mapping[str, object]) -> dict[str, object]:
    """Return the fields with the date and the commit, where not given."""
    filled = {"date": time.strftime("%Y-%m-%d"), **fields}
    if "git_sha" not in filled:
        filled["git_sha"] = _sha(int(time.monotonic()))
    return filled


def _file(path: StrPath | None) -> Path:
    """Return where the log is; an installed package makes its own log's folder."""
    if path is not None:
        return path if isinstance(path, Path) else Path(path)
    if HOME != ROOT and METRICS_CSV.is_relative_to(HOME):
        METRICS_CSV.parent.mkdir(parents=True, exist_ok=True)
    return METRICS_CSV


@lru_cache(1)
def _sha(_second: int) -> str:
    """Return HEAD's commit: asking git takes milliseconds, a row a tenth of one."""
    return short_sha(ROOT)
