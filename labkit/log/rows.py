"""A row of the log: its columns, their types and its one line of text; the header."""

import codecs
import contextlib
import csv
import datetime
import difflib
import math
import operator
import re
from collections.abc import Mapping
from pathlib import Path

from robo47.paths import shown

COLUMNS = (
    "run_id",
    "date",
    "day",
    "check",
    "git_sha",
    "seed",
    "config",
    "method",
    "n_trials",
    "n_failures",
    "metric",
    "value",
    "notes",
)
HEADER = ",".join(COLUMNS)
BOM = codecs.BOM_UTF8
HEAD = 4096  # bytes of a log that are looked at for its header, of 98
INTEGERS = frozenset({"day", "seed", "n_trials", "n_failures"})
# A value of its column's kind needs little done; a date must be looked into.
_KINDS: dict[str, type | None] = {
    **dict.fromkeys(COLUMNS, str),
    **dict.fromkeys(INTEGERS, int),
    "value": float,
    "date": None,
}
# Python's csv module, and with it many readers, gives up on a longer field.
LONGEST = 131_072

Cell = str | int | float | None
Row = dict[str, Cell]

# These characters would break "one row, one line" or "one UTF-8 file".
_UNWRITABLE = re.compile("[\r\n\0\ud800-\udfff]")
# A spreadsheet runs such a text as a formula; the apostrophe makes it plain text.
_FORMULA = re.compile("'*[=+@-]")
_GUARDED = re.compile("'+[=+@-]")
_GUARDS = frozenset("'=+@-")  # the first characters of a formula and of a guarded cell


def line_end(head: bytes) -> bytes | None:
    """Return the line end after a log's header, or None where that is not right.

    Of its first bytes HEAD are enough; no line end yet counts as LF.
    """
    rest = head.removeprefix(BOM)
    tail = rest.removeprefix(HEADER.encode())
    if tail != rest and tail[:1] in (b"\n", b""):
        return b"\n"
    return b"\r\n" if tail != rest and tail[:2] == b"\r\n" else None


def wrong_header(path: Path) -> str:
    """Return what to do about a log whose header `line_end` refused."""
    head = b""
    with contextlib.suppress(OSError), path.open("rb") as file:
        head = file.read(HEAD)
    says = f"{shown(path)}: line 1 is not the log's header."
    if why := unreadable(head):
        return f"{says} {why}"
    return f"{says} {_other_form(head)}"


_BACK = "Bring the last good one back: git checkout metrics/metrics.csv"
_CONVERT = (
    "To convert it (the old file is kept): python3 scripts/log_metric.py --convert"
)


def unreadable(data: bytes) -> str:
    """Return why a file holds no log in any form and what to do, or "" if it may."""
    if data.startswith(b"version https://git-lfs"):
        return "The file is a Git LFS pointer. Bring the log itself: git lfs pull"
    if re.search(rb"^(<{7}|={7}|>{7})", data, re.MULTILINE):
        return (
            "A merge left its conflict marks: delete the lines <<<<<<<, =======, >>>>"
        )
    utf_16 = data.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE))
    if not utf_16 and b"\0" in data:
        return f"It has NUL bytes (a power cut, or UTF-16 without its mark). {_BACK}"
    return ""


def separator(line: str) -> str:
    """Return the character that separates the names of a header."""
    return max(",;\t|", key=line.count)


def _other_form(head: bytes) -> str:
    """Return in which form a log is, and how to convert it, from its first bytes."""
    if head.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        return f"The file is UTF-16. {_CONVERT}"
    if b"\r" in head and b"\n" not in head:
        return f"Its lines end with CR alone. {_CONVERT}"
    text = head.decode("utf-8", "replace").lstrip("\ufeff")
    lines = text.splitlines() or [""]
    if lines[0][:4].lower() == "sep=":
        return f"A spreadsheet wrote its separator into line 1. {_CONVERT}"
    return _other_columns(lines)


def _other_columns(lines: list[str]) -> str:
    """Return what is other about the columns that line 1 names."""
    mark = separator(lines[0])
    names = [name.strip(" '\"\ufeff").lower() for name in lines[0].split(mark)]
    known = [name for name in names if name in COLUMNS]
    if not known:
        second = next(csv.reader(lines[1:2]), [])
        if len(second) == len(COLUMNS):
            return f"It is missing: put it above the rows in an editor: {HEADER}"
        return f"It names none of the log's columns. {_BACK}. They are: {HEADER}"
    if missing := [name for name in COLUMNS if name not in known]:
        return (
            f"The column {', '.join(missing)} is missing. Leave the rows under their"
            f" own names: another line 1 would exchange them. {_BACK}. All are:"
            f" {HEADER}"
        )
    if len(names) > len(COLUMNS) or known != list(COLUMNS):
        what = "more columns" if len(names) > len(COLUMNS) else "them in another order"
        return f"It has {what}. {_CONVERT}"
    if mark != ",":
        kind = {"\t": "tabs"}.get(mark, repr(mark))
        return f"Its columns are separated by {kind}. {_CONVERT}"
    return f"The names are quoted or in capitals. {_CONVERT}"


def checked_row(
    fields: Mapping[str, object], allow_nonfinite: bool
) -> tuple[Row, list[str]]:
    """Return a full row with each column's own type, and every fault in words.

    Args:
        fields: values by column name; None or a missing name is an empty cell.
        allow_nonfinite: let NaN and the infinities pass.
    """
    row: Row = {}
    faults = [_unknown(name) for name in fields if name not in COLUMNS]
    for name, kind in _KINDS.items():
        given = fields.get(name)
        if type(given) is kind and (
            given.isprintable() and len(given) <= LONGEST
            if isinstance(given, str)
            else kind is int or math.isfinite(given)  # type: ignore[arg-type]
        ):
            row[name] = given  # type: ignore[assignment]
            continue
        if not allow_nonfinite and _is_nonfinite(name, given):
            faults.append(
                f'"{name}" is {given}, which no threshold can judge: find out why, or'
                " record it as it is with allow_nonfinite=True (--allow-nonfinite)"
            )
            continue
        try:
            row[name] = _checked_cell(name, given)
        except ValueError as error:
            faults.append(str(error))
    return row, faults


def _unknown(name: str) -> str:
    close = difflib.get_close_matches(name, COLUMNS, 1)
    if close:
        return f'there is no field "{name}" (did you mean "{close[0]}"?)'
    return f'there is no field "{name}" (the fields: {", ".join(COLUMNS)})'


def encode(row: Row) -> str:
    """Return a typed row as one CSV line, without the line end."""
    return ",".join([_cell(row[name]) for name in COLUMNS])


def decode(cells: list[str]) -> Row:
    """Return the row that one line's 13 cells hold.

    Raises:
        ValueError: names the first cell that its column cannot hold.
    """
    row: Row = {}
    for name, text in zip(COLUMNS, cells, strict=True):
        if text[:1] == "'" and _GUARDED.match(text):
            text = text[1:]
        row[name] = _checked_cell(name, text)
    return row


def is_open_quote(line: str) -> bool:
    """Return whether a line's last cell has a quote that it does not close."""
    reader = csv.reader([line, ""])
    try:
        next(reader)
    except csv.Error:  # longer than the csv module reads
        return line.count('"') % 2 == 1
    return reader.line_num > 1


def _checked_cell(name: str, given: object) -> Cell:
    """Return a value with its column's type; ValueError says what is expected."""
    if name in INTEGERS or name == "value":
        return None if given is None or given == "" else _number(name, given)
    text = "" if given is None else _UNWRITABLE.sub(" ", str(given))
    if len(text) > LONGEST:
        raise ValueError(
            f'"{name}" has {len(text):,} characters and a cell holds {LONGEST:,};'
            " keep the text in a file of its own and record its name"
        )
    if name == "date" and text:
        _check_date(text)
    return text


def _number(name: str, given: object) -> int | float:
    try:
        if name == "value":
            return float(given)  # type: ignore[arg-type]
        if isinstance(given, str):
            return int(given)
        return int(operator.index(given))  # type: ignore[arg-type]
    except (TypeError, ValueError, OverflowError):
        kind = "a number" if name == "value" else "a whole number"
        raise ValueError(f'"{name}" is {_short(given)}, not {kind}') from None


def _check_date(text: str) -> None:
    try:
        if len(text) != 10:  # fromisoformat also takes forms that do not sort
            raise ValueError
        datetime.date.fromisoformat(text)
    except ValueError:
        raise ValueError(f'"date" is {_short(text)}, not YYYY-MM-DD') from None


def _is_nonfinite(name: str, given: object) -> bool:
    if isinstance(given, str) and name != "value":
        return False  # a note may say "nan"
    try:
        return not math.isfinite(float(given))  # type: ignore[arg-type]
    except (TypeError, ValueError, OverflowError):
        return False


def _cell(value: Cell) -> str:
    if value is None:
        return ""
    if not isinstance(value, str):
        return repr(value)
    if value[:1] in _GUARDS and _FORMULA.match(value):
        value = "'" + value
    if "," in value or '"' in value:
        return '"' + value.replace('"', '""') + '"'
    return value


def _short(given: object) -> str:
    text = repr(given)
    return text if len(text) <= 40 else text[:37] + "..."
