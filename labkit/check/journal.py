"""What the checker said, kept on the student's machine: `.robo47/journal.jsonl`.

One line per task whose verdict changed. `make report` reads from it which named
mistakes were met and left behind; nothing is sent anywhere, and git ignores it.
"""

import contextlib
import json
import re
from collections.abc import Iterable, Mapping, Sequence
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
    """How a task stood from a moment on."""

    task: str  # its id
    status: str  # as in a verdict
    mistake: str  # its name, "" where it has none
    says: str = ""  # the first sentence of what the checker said of it


class Met(NamedTuple):
    """A mistake that was made."""

    task: str  # its id
    mistake: str  # its name
    # "left behind" where the task passes, "still there" where the last check of the
    # file as it is found it, "not checked since" where there was none, "not right yet"
    # where that check found something else.
    now: str
    says: str = ""  # what the checker said of it when it was met, in a sentence


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
            says = _sentence(verdict.message) if state[1] else ""
            entry = Entry(result.task.id, *state, says)
            lines.append(json.dumps(entry))
    store.add_lines(NAME, lines, root)


def read(root: Path = ROOT) -> list[Entry]:
    """Return the journal, oldest first; what cannot be read is left out."""
    found = []
    for line in store.read_text(NAME, root).splitlines():
        with contextlib.suppress(ValueError, TypeError, LookupError):
            words = json.loads(line)
            words = words[isinstance(words[0], float) :]  # older kits wrote the time
            found.append(Entry(*map(str, words)))
    return found


def mistakes_met(entries: Iterable[Entry], known: Mapping[str, str]) -> list[Met]:
    """Return every named mistake once per task, in the order they were met.

    Args:
        entries: of the journal, oldest first.
        known: how tasks stand in the file as it is, as `states.known` has it.
    """
    met: dict[tuple[str, str], str] = {}
    last: dict[str, str] = {}
    for entry in entries:
        last[entry.task] = entry.mistake
        if entry.status in ("wrong", "close") and entry.mistake not in _NO_MISTAKE:
            met.setdefault((entry.task, entry.mistake), entry.says)
    found = []
    for (task, slug), says in met.items():
        match known.get(task):
            case None:
                now = "not checked since"
            case "passed":
                now = "left behind"
            case "wrong" | "close" if last[task] == slug:
                now = "still there"
            case _:
                now = "not right yet"
        found.append(Met(task, slug, now, says))
    return found


def _sentence(message: str) -> str:
    """Return the first sentence of a message, at most 200 characters of it."""
    first = re.split(r"(?<=[.:;]) (?=[A-Z])|\n", message, maxsplit=1)[0]
    return first if len(first) <= 200 else first[:199] + "…"
