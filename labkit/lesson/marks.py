"""What a row of the log is worth: its number's range, and which file wrote it.

The file's mark, as it was then, stands at the end of the row's notes.
"""

import math
import re
from collections.abc import Mapping, Sequence, Set
from dataclasses import dataclass
from typing import Any

Row = Mapping[str, Any]  # of the log, by column
_FILE = re.compile(r"\bfile ([0-9a-f]{8})$")


@dataclass(frozen=True)
class Metric:
    """A row that the log must hold, and the range of its value; None is no bound."""

    check: str
    metric: str
    max: float | None = None
    min: float | None = None

    @property
    def limit(self) -> str:
        """The range as people write it: "under 1e-08"."""
        parts = [] if self.min is None else [f"over {self.min:g}"]
        parts += [] if self.max is None else [f"under {self.max:g}"]
        return " and ".join(parts)

    def passes(self, value: float) -> bool:
        """Return whether a value is within the range; NaN never is."""
        high = self.max is None or value < self.max
        return value == value and high and (self.min is None or value > self.min)

    def judge(self, row: Row | None) -> str:
        """Return how a row of the log stands: "pass", "fail", or "none" without one.

        Nothing else in the kit decides this.
        """
        return "none" if row is None else "fail" if self.fault(row) else "pass"

    def fault(self, row: Row) -> str:
        """Return what is wrong with a row's number; "" where it is as it must be."""
        value = row["value"]
        if not isinstance(value, int | float) or not math.isfinite(value):
            return f"is {value}, not a number"
        if value < 0 and self.min is None:
            return f"is {value:.3g}, and an error is never negative"
        if not self.passes(value):
            return f"is {value:.3g}; it must be {self.limit}"
        if failures := row["n_failures"]:
            return f"failed in {failures} of {row['n_trials'] or '?'} trials"
        return ""


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
