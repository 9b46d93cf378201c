"""The first line of the log: which ones are right, and what is wrong with others."""

import codecs
from typing import NamedTuple

from robo47.metrics.rows import COLUMNS

LINE = ",".join(COLUMNS)
BOM = codecs.BOM_UTF8
REPAIR = "python scripts/log_metric.py --repair writes a mended copy"
UTF16 = (
    "it holds UTF-16 text, as PowerShell's > and >> write it. Append with"
    f" scripts/log_metric.py instead; {REPAIR}."
)
LONGEST = 4096  # bytes that are looked at; the right line has 98

_RIGHT = LINE.encode()


class Layout(NamedTuple):
    """How a file that is not quite the log may still be read."""

    names: tuple[str, ...] = COLUMNS
    delimiter: str = ","
    utf16: bool = False
    has_header: bool = True


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
        names = tuple(
            name.strip().strip('"').strip() for name in first.split(delimiter)
        )
        if len(set(names) & set(COLUMNS)) > 2:
            return Layout(names, delimiter, utf16)
    delimiter = ";" if first.count(";") >= len(COLUMNS) - 1 else ","
    return Layout(COLUMNS, delimiter, utf16, has_header=False)


def problem(head: bytes) -> str:
    """Return what is wrong with a header that `line_end` refused, and what to do."""
    seen = layout(head)
    if seen.utf16:
        return UTF16
    if not _first_line(_decoded(head, utf16=False)).strip():
        return f"its first line is blank. Make the first line: {LINE}"
    if not seen.has_header:
        return f"it has no header. Make the first line: {LINE}"
    if seen.delimiter != ",":
        mark = "semicolons" if seen.delimiter == ";" else "tabs"
        return (
            f"its columns are separated by {mark}, as a spreadsheet saves them. Save"
            f' it as "CSV UTF-8 (comma delimited)", or: {REPAIR}.'
        )
    return f"its header is wrong: {_difference(seen.names)}. It must be: {LINE}"


def is_utf16_end(end: bytes) -> bool:
    """Return whether a file's last two bytes are a UTF-16 line end."""
    return end in (b"\n\0", b"\0\n")


def _decoded(head: bytes, utf16: bool) -> str:
    if utf16:
        return head[: len(head) // 2 * 2].decode("utf-16", "replace")
    return head.removeprefix(BOM).decode("utf-8", "replace")


def _first_line(text: str) -> str:
    return text.partition("\n")[0].rstrip("\r")


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
