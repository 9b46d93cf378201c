"""What the checker said, kept on the student's machine: `.robo47/journal.jsonl`.

One line per task whose verdict changed. `make report` reads from it which named
mistakes were met and left behind; nothing is sent anywhere, and git ignores it.
"""

import contextlib
import json
import time
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from labkit.base import store
from robo47.paths import ROOT

if TYPE_CHECKING:
    from labkit.check.tasks import TaskResult

NAME = "journal.jsonl"

# Verdicts that say that nothing was judged, not that a mistake was made.
_NO_MISTAKE = {"", "unwritten", "waits", "inherited", "borrowed", "does-not-load"}
_NO_MISTAKE |= {"missing", "raise-left-in"}


class Entry(NamedTuple):
    """How a task stood from a moment on.

    Attributes:
        when: seconds since 1970.
        task: its id.
        status: as in a verdict.
        mistake: its name, "" where it has none.
    """

    when: float
    task: str
    status: str
    mistake: str


class Met(NamedTuple):
    """A mistake that was made: in which task, and whether the task passes since."""

    task: str
    mistake: str
    left_behind: bool


def note(results: Sequence["TaskResult"], root: Path = ROOT) -> None:
    """Add what is new; a folder that cannot be written costs the memory alone."""
    last = {entry.task: entry for entry in read(root)}
    lines = []
    for result in results:
        known = last.get(result.task.id)
        verdict = result.verdict
        # What follows from another task is no mistake of its own.
        state = (verdict.status, "" if verdict.follows else verdict.mistake)
        if known is None or (known.status, known.mistake) != state:
            entry = Entry(round(time.time(), 1), result.task.id, *state)
            lines.append(json.dumps(entry))
    store.add_lines(NAME, lines, root)


def read(root: Path = ROOT) -> list[Entry]:
    """Return the journal, oldest first; what cannot be read is left out."""
    found = []
    for line in store.read_text(NAME, root).splitlines():
        with contextlib.suppress(ValueError, TypeError):
            when, task, status, mistake = json.loads(line)
            found.append(Entry(float(when), str(task), str(status), str(mistake)))
    return found


def mistakes_met(entries: Iterable[Entry]) -> list[Met]:
    """Return every named mistake once per task, in the order they were met."""
    met: dict[tuple[str, str], None] = {}
    status: dict[str, str] = {}
    for entry in entries:
        status[entry.task] = entry.status
        if entry.status in ("wrong", "close") and entry.mistake not in _NO_MISTAKE:
            met.setdefault((entry.task, entry.mistake))
    return [Met(task, slug, status[task] == "passed") for task, slug in met]
