"""Task states by the checker's last word: `.robo47/statuses.json`.

A state counts for as long as neither the student's files nor the kit change. It is read
without MuJoCo and the sandbox.
"""

import functools
import hashlib
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from labkit.base import store
from labkit.handin.handin import helpers_of
from labkit.lesson.day import Day
from robo47.paths import ROOT

if TYPE_CHECKING:
    from labkit.check.tasks import TaskResult
    from labkit.judge import Verdict

NAME = "statuses.json"
KEPT = 50  # keys


def known(day: Day) -> dict[str, str]:
    """Return how tasks stand in the file as it is: "passed", "wrong", "to do" ...

    Returns:
        By task; a task that was not checked since a change is not in it.
    """
    if not day.work.is_file():
        return {task.id: "not begun" for task in day.tasks}
    return _of(store.read(NAME), key_of(day))


def remember(key: str, results: Sequence["TaskResult"]) -> dict[str, str]:
    """Keep the checker's word on files of a key taken before it; return it, by task."""
    states = {result.task.id: in_words(result.verdict) for result in results}
    if all(result.verdict.mistake != "stopped" for result in results):
        # a bad moment of this machine is not remembered
        memory = store.read(NAME)
        before = _of(memory, key)
        memory.pop(key, None)
        newest = {**memory, key: {**before, **states}}
        store.write(NAME, dict(list(newest.items())[-KEPT:]))
    return states


def key_of(day: Day) -> str:
    """Return what changes with the student's files, the day's own and the kit's.

    Of the student's it is the day's script and what that imports: a line of another
    day's file leaves a day as it was checked.
    """
    script = day.files["script"]
    content = day.work.read_bytes() if day.work.is_file() else b""
    helpers = helpers_of(day.folder.parent, script, {script: content})
    own = [f"{name}\0".encode() + helpers[name] for name in sorted(helpers)]
    given = hashlib.sha256(b"\0".join([content, *own, _kit()])).digest()
    digest = _digest(sorted(day.own.rglob("*.py")), given)
    return f"{day.number} {digest.hex()[:16]}"


@functools.cache
def _kit() -> bytes:
    folders = (ROOT / "robo47", ROOT / "labkit")
    return _digest(path for folder in folders for path in sorted(folder.rglob("*.py")))


def _digest(files: Iterable[Path], before: bytes = b"") -> bytes:
    digest = hashlib.sha256(before)
    for path in files:
        digest.update(path.read_bytes() if path.is_file() else b"")
    return digest.digest()


def _of(memory: dict[str, Any], key: str) -> dict[str, str]:
    found = memory.get(key)
    return found if isinstance(found, dict) else {}


def in_words(verdict: "Verdict") -> str:
    """Return how a task stands by a verdict on it: "passed", "wrong", "to do" ..."""
    if verdict.mistake == "does-not-load":
        return "the file does not load"
    if verdict.mistake in ("inherited", "borrowed"):
        return "waits" if verdict.mistake == "inherited" else "borrowed"
    return "to do" if verdict.status == "todo" else verdict.status
