"""The mark in a row's notes: which file wrote it, as the file was then."""

import hashlib
import re

from labkit.log.rows import Row

_FILE = re.compile(r"\bfile ([0-9a-f]{8})$")


def file_mark(script: bytes) -> str:
    """Return what the notes of a script's rows end with: "file 1234abcd"."""
    return f"file {hashlib.sha256(script).hexdigest()[:8]}"


def mark_of(row: Row) -> str:
    """Return the mark of the file that wrote a row, or ""."""
    found = _FILE.search(str(row["notes"]))
    return found[0] if found else ""


def marks_of(script: bytes | None) -> set[str]:
    """Return a file's mark with either line end: git may have changed them."""
    if script is None:
        return set()
    unix = script.replace(b"\r\n", b"\n")
    return {file_mark(data) for data in (script, unix, unix.replace(b"\n", b"\r\n"))}
