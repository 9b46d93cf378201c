"""The checker's last words, kept on the student's machine; nothing is sent anywhere.

`.robo47/statuses.json` says how tasks stand: a state counts for as long as neither the
student's files nor the kit change. `.robo47/journal.jsonl` has a line per task whose
verdict changed: `make report` reads from it which named mistakes were met and left
behind. Both are read without MuJoCo and the sandbox. `.robo47/labs.json` says with
which files a lab passed to its end, so the check of the day does not run it again.
"""

import contextlib
import functools
import hashlib
import importlib.metadata
import json
import re
import sys
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from labkit.base import store
from labkit.lesson.day import Day, Task
from labkit.lesson.untrusted_files import helpers_of
from robo47.paths import ROOT

if TYPE_CHECKING:
    from labkit.check.tasks import TaskResult
    from labkit.judge import Verdict

STATES, JOURNAL, LABS = "statuses.json", "journal.jsonl", "labs.json"
KEPT = 50  # keys
LABEL = 40  # letters: what ends with a colon and is no longer names a result

# Verdicts that say that nothing was judged, not that a mistake was made.
_NO_MISTAKE = {"", "unwritten", "waits", "inherited", "borrowed", "does-not-load"}
_NO_MISTAKE |= {"missing", "raise-left-in"}


class Entry(NamedTuple):
    """The state of a task from a moment on."""

    task: str  # its id
    status: str  # the status of a verdict
    mistake: str  # its name, "" where it has none
    says: str = ""  # the first sentence of what the checker said of it


class MetMistake(NamedTuple):
    """A mistake that was made."""

    task: str  # its id
    mistake: str  # its name
    # "left behind" where the task passes, "still there" where the last check of the
    # file as it is found it, "not checked since" where there was none, "not right yet"
    # where that check found something else.
    now: str
    says: str = ""  # the checker's sentence when the student first met it


def task_states(day: Day) -> dict[str, str]:
    """Return how tasks stand in the file as it is: "passed", "wrong", "to do" ...

    Returns:
        By task; a task that was not checked since a change is not in it.
    """
    if not day.work.is_file():
        return {task.id: "not begun" for task in day.tasks}
    return _entry(store.read(STATES), key_of(day))


def passing(day: Day, states: Mapping[str, str]) -> list[str]:
    """Return the functions of a day's tasks that pass, by how its tasks stand."""
    return [f for t in day.tasks if states.get(t.id) == "passed" for f in t.functions]


def remember(key: str, results: Sequence["TaskResult"]) -> dict[str, str]:
    """Keep the checker's word on files of a key taken before it; return it, by task."""
    states = {result.task.id: state_of(result.verdict) for result in results}
    if all(result.verdict.mistake != "stopped" for result in results):
        # a bad moment of this machine is not remembered
        memory = store.read(STATES)
        before = _entry(memory, key)
        memory.pop(key, None)
        newest = {**memory, key: {**before, **states}}
        store.write(STATES, dict(list(newest.items())[-KEPT:]))
    return states


def key_of(day: Day) -> str:
    """Return what changes with the student's files, the day's own and the kit's.

    Of the student's it is the day's script and what that imports: a line of another
    day's file leaves a day as it was checked.
    """
    script = day.files["script"]
    content = day.work.read_bytes() if day.work.is_file() else b""
    helpers = helpers_of(day.folder.parent, script, content)
    own = [f"{name}\0".encode() + helpers[name] for name in sorted(helpers)]
    kits = [_kit(), _digest(day.own)]
    digest = hashlib.sha256(b"\0".join([content, *own, *kits]))
    return f"{day.number} {digest.hexdigest()[:16]}"


def lab_key(day: Day) -> str:
    """Return what changes with anything that the lab's run depends on.

    It adds to `key_of` the labs, the manifests, and the versions of the packages. A run
    has seeds of its own, so the seed of a check is no part of it.
    """
    kits = [*ROOT.glob("w*/src/*.py"), *ROOT.glob("robo47/panda/models/*.xml")]
    week = [*day.folder.glob("*.toml"), *day.folder.rglob("*.xml"), *_own_texts(day)]
    files = sorted(path for path in {*kits, *week} if path.is_file())
    digest = hashlib.sha256(b"\0".join(path.read_bytes() for path in files))
    versions = [sys.version, *map(importlib.metadata.version, ("numpy", "mujoco"))]
    digest.update(" ".join(versions).encode())
    return f"{key_of(day)} {digest.hexdigest()[:16]}"


def _own_texts(day: Day) -> list[Path]:
    return [*day.own.rglob("*.py"), *day.own.rglob("*.toml")]


def lab_passed(key: str) -> bool:
    """Return whether the lab passed to its end with all that a key stands for."""
    return store.read(LABS).get(key) is True


def note_lab(key: str) -> None:
    """Keep that the lab passed to its end with all that a key stands for."""
    memory = store.read(LABS)
    memory.pop(key, None)
    store.write(LABS, dict(list({**memory, key: True}.items())[-KEPT:]))


def state_of(verdict: "Verdict") -> str:
    """Return how a task stands by a verdict on it: "passed", "wrong", "to do" ..."""
    if verdict.mistake == "does-not-load":
        return "the file does not load"
    if verdict.mistake in ("inherited", "borrowed"):
        return "waits" if verdict.mistake == "inherited" else "borrowed"
    return "to do" if verdict.status == "todo" else verdict.status


def note(results: Sequence["TaskResult"], root: Path = ROOT) -> None:
    """Add what is new; a folder that cannot be written costs the memory alone."""
    last = {entry.task: entry for entry in journal(root)}
    lines = []
    for result in results:
        known = last.get(result.task.id)
        verdict = result.verdict
        # A failure that follows from another task is no mistake of its own.
        mistake = "" if verdict.follows else verdict.mistake
        says = first_sentence(verdict.message) if mistake else ""
        now = Entry(result.task.id, verdict.status, mistake, says)
        if known is None or known._replace(says=says) != now:
            lines.append(json.dumps(now))
    store.add_lines(JOURNAL, lines, root)


def not_passed(day: Day, checked: str) -> list[Task]:
    """Return the other required tasks whose last check did not pass, or never was.

    Args:
        day: from its manifest.
        checked: the id of the task that was checked just now.
    """
    last = {entry.task: entry.status for entry in journal()}
    asked = [task for task in day.tasks if not task.optional and task.id != checked]
    return [task for task in asked if last.get(task.id) != "passed"]


def journal(root: Path = ROOT) -> list[Entry]:
    """Return the journal, oldest first; what cannot be read is left out."""
    found = []
    for line in store.read_text(JOURNAL, root).splitlines():
        with contextlib.suppress(ValueError, TypeError, LookupError):
            words = json.loads(line)
            words = words[isinstance(words[0], float) :]  # older kits wrote the time
            found.append(Entry(*map(str, words)))
    return found


def mistakes_met(
    entries: Iterable[Entry], known: Mapping[str, str]
) -> list[MetMistake]:
    """Return every named mistake once per task, in the order they were met.

    Args:
        entries: of the journal, oldest first.
        known: how tasks stand in the file as it is, as `known` has it.
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
        found.append(MetMistake(task, slug, now, says))
    return found


@functools.cache
def _kit() -> bytes:
    return _digest(ROOT / "robo47") + _digest(ROOT / "labkit")


def _digest(folder: Path) -> bytes:
    files = (path for path in sorted(folder.rglob("*.py")) if path.is_file())
    return hashlib.sha256(b"\0".join(path.read_bytes() for path in files)).digest()


def _entry(memory: dict[str, Any], key: str) -> dict[str, str]:
    found = memory.get(key)
    return found if isinstance(found, dict) else {}


def first_sentence(message: str) -> str:
    """Return the first sentence of a message, at most 200 characters of it.

    A name in front of it, "sigma: Off by 2.", is none yet.
    """
    first, *rest = re.split(r"(?<=[.:;]) (?=[A-Z])|\n", message, maxsplit=2)
    if rest and first.endswith(":") and len(first) <= LABEL:
        first = f"{first} {rest[0]}"
    return first if len(first) <= 200 else first[:199] + "…"
