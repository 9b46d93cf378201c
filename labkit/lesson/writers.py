"""The file that wrote a row of the log, and whether the row still counts.

The file's mark, as it was then, stands at the end of the row's notes.
"""

import re
from collections.abc import Sequence, Set
from dataclasses import dataclass

from labkit.lesson.borrowed import borrowed_tasks
from labkit.lesson.day import Day
from labkit.lesson.metric import Metric, Row

_FILE = re.compile(r"\bfile ([0-9a-f]{8})$")


def file_mark(script: bytes) -> str:
    """Return what the notes of a script's rows end with: "file 1234abcd"."""
    import hashlib  # it loads OpenSSL: 2 ms that `make start` has no use for

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


@dataclass(frozen=True)
class Writers:
    """The files that may have written a day's rows."""

    kits: Set[str] = frozenset()  # marks of the kit's own script
    # Marks of the student's file as it is now; None for somebody else's log.
    own: Set[str] | None = None
    # Ids of the tasks whose functions that file borrows from the kit.
    borrowed: Sequence[str] = ()

    def judge(self, metric: Metric, row: Row | None) -> str:
        """Return what a row is worth now.

        Returns:
            "none", "pass" or "fail" as the manifest has it; "stale" where the file
            has changed since, "unsigned" where the row does not say which file wrote
            it, "borrowed" where a passing one is not the student's work alone.
        """
        if row is not None and self.own is not None and mark_of(row) not in self.own:
            return "stale" if mark_of(row) else "unsigned"
        verdict = metric.judge(row)
        return "borrowed" if self.borrowed and verdict == "pass" else verdict


def writers_of(day: Day, script: bytes | None = None) -> Writers:
    """Return the files that may have written a day's rows in a student's log.

    Args:
        day: from its manifest.
        script: the student's; by default as it is now, b"" where there is none.
    """
    kits = day.source.read_bytes() if day.source.is_file() else None
    if script is None:
        script = day.work.read_bytes() if day.work.is_file() else b""
    borrowed = borrowed_tasks(day, script.decode("utf-8", "replace"))
    # No script has no mark: that of an empty one would make a row somebody's.
    return Writers(
        kits=marks_of(kits or None),
        own=marks_of(script or None),
        borrowed=[task.id for task in borrowed],
    )
