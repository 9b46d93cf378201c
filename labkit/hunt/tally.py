"""The log's rows of hunts, and what they add up to: "found 5 of 6 in 14 runs"."""

from __future__ import annotations  # a report reads rows without a catalogue

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

from labkit.base.text import count

if TYPE_CHECKING:
    from labkit.hunt.case import Case

CHECK = "hunt"  # the name of its row in the log
METRIC = "runs"
# How a hunt ended, the first word of its row's notes.
FOUND = "found"  # repaired
NAMED = "named"  # the right function was suspected, and not repaired
GAVE_UP = "gave up"
LEFT = "left"  # another was begun
ENDS = (FOUND, NAMED, GAVE_UP, LEFT)


def row_of(case: Case, innocent: Iterable[str] = ()) -> dict[str, Any]:
    """Return the row of a hunt that has ended.

    Args:
        case: the hunt.
        innocent: functions that were right and were written anew.
    """
    wrong = {function for function, _ in case.suspected} | set(innocent)
    told = "" if case.ended == LEFT else f": {' and '.join(sorted(case.guilty))}"
    never = case.ended == FOUND and not case.named
    return {
        "run_id": f"hunt_day{case.day}",
        "day": case.day,
        "check": CHECK,
        "seed": case.seed,
        "method": f"level {case.level}",
        "n_trials": case.checks,
        "n_failures": len(wrong - case.guilty),
        "metric": METRIC,
        "value": float(case.runs),
        "notes": f"{case.ended}{told}{' (never suspected)' if never else ''}",
    }


def ending(row: Mapping[str, Any]) -> str:
    """Return how the hunt of a row ended; "" where the row is of no hunt."""
    if row.get("check") != CHECK:
        return ""
    notes = str(row.get("notes", ""))
    return next((end for end in ENDS if notes.startswith(end)), "")


def tally(rows: Iterable[Mapping[str, Any]]) -> str:
    """Return "found 5 of 6 in 14 runs" of a log's rows; "" where nobody hunted."""
    hunts = [row for row in rows if ending(row)]
    if not hunts:
        return ""
    found = sum(ending(row) == FOUND for row in hunts)
    runs = sum(int(row.get("value") or 0) for row in hunts)
    words = f"found {found} of {len(hunts)} in {count(runs, 'run')}"
    named = sum(ending(row) == NAMED for row in hunts)
    return f"{words}, named {named} more" if named else words
