"""The first line of the log: the columns' names, and nothing else."""

import codecs
from pathlib import Path

from labkit.log.rows import COLUMNS
from robo47.paths import shown

LINE = ",".join(COLUMNS)
BOM = codecs.BOM_UTF8
LONGEST = 4096  # bytes that are looked at; the right line has 98

_RIGHT = LINE.encode()


def line_end(head: bytes) -> bytes | None:
    """Return the line end that a file's header uses, or None if it is not right.

    Of the first bytes LONGEST are enough; no line end yet counts as LF.
    """
    rest = head.removeprefix(BOM)
    if rest.startswith(_RIGHT):
        tail = rest[len(_RIGHT) :]
        if tail[:1] in (b"\n", b""):
            return b"\n"
        if tail[:2] == b"\r\n":
            return b"\r\n"
    return None


def problem(path: Path) -> str:
    """Return what to do about the log at `path`, whose header `line_end` refused."""
    return (
        f"{shown(path)}: line 1 is not the log's header. Put it there in an editor and"
        f" save as UTF-8 (in a spreadsheet: CSV UTF-8, comma delimited): {LINE}"
    )
