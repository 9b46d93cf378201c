"""The first line of the log: which ones are right, and what is wrong with others."""

import codecs
import difflib
from pathlib import Path
from typing import NamedTuple

from labkit.base.words import command
from labkit.log.rows import COLUMNS

LINE = ",".join(COLUMNS)
BOM = codecs.BOM_UTF8
_UTF16 = "it holds UTF-16 text, as PowerShell's > and >> write it"
NEAR = 0.7  # difflib's ratio: "val" is near "value", "mood" is not near "method"
LONGEST = 4096  # bytes that are looked at; the right line has 98

_RIGHT = LINE.encode()


class Layout(NamedTuple):
    """How a file that is not quite the log may still be read."""

    names: tuple[str, ...] = COLUMNS
    delimiter: str = ","
    utf16: bool = False
    has_header: bool = True
    is_clear: bool = True  # False: it cannot be told which column is which


def line_end(head: bytes) -> bytes | None:
    """Return the line end that a file's header uses, or None if it is not right.

    Args:
        head: the file's first bytes, LONGEST at most. No line end yet counts as LF.
    """
    rest = head.removeprefix(BOM)
    if rest.startswith(_RIGHT):
        tail = rest[len(_RIGHT) :]
        if tail[:1] in (b"\n", b""):
            return b"\n"
        if tail[:2] == b"\r\n":
            return b"\r\n"
    return None


def layout(head: bytes) -> Layout:
    """Return how to read a file with these first bytes, as well as can be told."""
    utf16 = head[:2] in (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)
    first = _first_line(_decoded(head, utf16).lstrip())
    for delimiter in (",", ";", "\t"):
        names = _names(first, delimiter)
        if len(set(names) & set(COLUMNS)) > 2:
            meant = _meant(names)
            return Layout(meant or names, delimiter, utf16, is_clear=meant is not None)
    delimiter = ";" if first.count(";") >= len(COLUMNS) - 1 else ","
    return Layout(COLUMNS, delimiter, utf16, has_header=False)


def fault(head: bytes) -> str:
    """Return what is wrong with a header that `line_end` refused."""
    seen = layout(head)
    if seen.utf16:
        return _UTF16
    first = _first_line(_decoded(head, utf16=False))
    if not first.strip():
        return "its first line is blank"
    if not seen.has_header:
        return "it has no header"
    if seen.delimiter != ",":
        mark = "semicolons" if seen.delimiter == ";" else "tabs"
        return f"its columns are separated by {mark}, as a spreadsheet saves them"
    return f"its header is wrong: {_difference(_names(first, ','))}"


def problem(head: bytes, path: Path) -> str:
    """Return `fault` and what to do about it, for the log at `path`."""
    seen = layout(head)
    said = fault(head)
    if not seen.is_clear:
        return (
            f"{said}. It cannot be told which column is which: in the first line,"
            f" give each column its own of these names: {LINE}"
        )
    if seen.utf16:
        return utf16_problem(path)
    repair = _repair(path)
    if seen.has_header and seen.delimiter != ",":
        return f'{said}. Save it as "CSV UTF-8 (comma delimited)", or: {repair}.'
    return f"{said}. {repair}; the first line must be: {LINE}"


def utf16_problem(path: Path) -> str:
    """Return what to do about a log that has UTF-16 text, at its start or later."""
    return f"{_UTF16}. Append with scripts/log_metric.py instead; {_repair(path)}."


def is_utf16_end(end: bytes) -> bool:
    """Return whether a file's last two bytes are a UTF-16 line end."""
    return end in (b"\n\0", b"\0\n")


def _repair(path: Path) -> str:
    return f"{command('--repair', path)} writes a repaired copy"


def _decoded(head: bytes, utf16: bool) -> str:
    if utf16:
        return head[: len(head) // 2 * 2].decode("utf-16", "replace")
    return head.removeprefix(BOM).decode("utf-8", "replace")


def _first_line(text: str) -> str:
    return text.partition("\n")[0].rstrip("\r")


def _names(first: str, delimiter: str) -> tuple[str, ...]:
    return tuple(name.strip().strip('"').strip() for name in first.split(delimiter))


def _meant(names: tuple[str, ...]) -> tuple[str, ...] | None:
    """Return the names with renamed columns called as they were; None if in doubt.

    A renamed column is the only one that is not in its place, or has a near name.
    """
    misplaced = sum(a != b for a, b in zip(names, COLUMNS, strict=False))
    if len(names) == len(COLUMNS) and misplaced == 1:
        return COLUMNS
    missing = [name for name in COLUMNS if name not in names]
    repaired = []
    for name in names:
        unknown = name not in COLUMNS
        near = difflib.get_close_matches(name.lower(), missing, 1, NEAR)
        repaired.append(near[0] if near and unknown else name)
    filled = [name for name in repaired if name]
    twice = len(set(filled)) < len(filled)
    either_way = set(repaired) - set(COLUMNS) and set(COLUMNS) - set(repaired)
    return None if twice or either_way else tuple(repaired)


def _difference(names: tuple[str, ...]) -> str:
    missing = [name for name in COLUMNS if name not in names]
    extra = [name for name in names if name not in COLUMNS]
    twice = sorted({name for name in names if names.count(name) > 1} - set(extra))
    said = []
    if missing:
        said.append(f"missing {', '.join(missing)}")
    if extra:
        said.append("extra " + ", ".join(name or "(empty)" for name in extra))
    if twice:
        said.append(f"twice {', '.join(twice)}")
    known = [name for name in dict.fromkeys(names) if name in COLUMNS]
    in_order = [name for name in COLUMNS if name in known]
    moved = [a for a, b in zip(known, in_order, strict=True) if a != b]
    if moved:
        said.append(f"out of order {', '.join(moved)}")
    return "; ".join(said) or "it has quotes or spaces around its names"
