"""A student's own functions of all days, each replaced by the library's where it fails.

    mine = load()
    mine.functions.solve_ik     the student's, if `make check` passes it
    mine.yours, mine.total      how many are theirs: "yours: 61 of 66"

The files run in this process, as `make run` runs them: they are the student's own, on
their own machine. Whether a function passes is the checker's word, in its sandbox.
"""

import hashlib
import json
import sys
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import Any

from labkit.check.tasks import check_tasks
from labkit.judge import Verdict
from labkit.lesson.day import Day, all_days
from labkit.sandbox.sandbox import Sandbox
from robo47 import capstone
from robo47.paths import ROOT


@dataclass
class Mine:
    """The week's functions, and whose they are.

    Attributes:
        functions: by name, ready for `capstone.pick`.
        yours: names that are the student's own.
        replaced: (day, name, why) of those that are the library's.
    """

    functions: SimpleNamespace
    yours: list[str] = field(default_factory=list)
    replaced: list[tuple[int, str, str]] = field(default_factory=list)

    @property
    def total(self) -> int:
        """How many functions the days ask for."""
        return len(self.yours) + len(self.replaced)


def load(days: Iterable[Day] | None = None) -> Mine:
    """Return the student's functions of some days, by default of all.

    Args:
        days: whose files in `work/` are loaded.
    """
    mine = Mine(capstone.library())
    for day in all_days() if days is None else days:
        why = statuses(day)
        module = _module(day) if "passed" in why.values() else None
        for task in day.tasks:
            for name in task.functions:
                own = getattr(module, name, None)
                if why[task.id] == "passed" and own is not None:
                    setattr(mine.functions, name, own)
                    mine.yours.append(name)
                else:
                    passed = why[task.id] == "passed"
                    told = "does not load here" if passed else why[task.id]
                    mine.replaced.append((day.number, name, told))
    return mine


def statuses(day: Day) -> dict[str, str]:
    """Return how each task of a day stands: "passed", "wrong", "to do" and so on.

    The checker's word is remembered for as long as neither the file nor the kit
    changes.
    """
    if not day.work.is_file():
        return {task.id: "not begun" for task in day.tasks}
    path, key = ROOT / ".robo47" / "statuses.json", _key(day)
    known = _read(path)
    if key not in known:
        with Sandbox() as sandbox:
            results = check_tasks(day, day.work, sandbox)
        known[key] = {r.task.id: _in_words(r.verdict) for r in results}
        if all(result.verdict.mistake != "stopped" for result in results):
            _write(path, known)  # a bad moment of this machine is not remembered
    return {task.id: known[key].get(task.id, "to do") for task in day.tasks}


def _in_words(verdict: Verdict) -> str:
    if verdict.mistake == "does-not-load":
        return "the file does not load"
    return "to do" if verdict.status == "todo" else verdict.status


def _module(day: Day) -> ModuleType | None:
    """Return a student's file as a module, or None where it does not load here."""
    module = ModuleType(day.work.stem)
    module.__file__ = str(day.work)
    sys.modules[module.__name__] = module  # as for an import: it may ask for itself
    sys.path.insert(0, str(day.work.parent))
    try:
        code = compile(day.work.read_bytes(), str(day.work), "exec")
        exec(code, vars(module))
    except Exception:  # the sandbox could load it; here something else is in the way
        return None
    finally:
        sys.path.remove(str(day.work.parent))
    return module


def _key(day: Day) -> str:
    """Return what changes with the student's files, the day's own and the kit's."""
    digest = hashlib.sha256()
    files = sorted(day.work.parent.glob("*.py"))
    for folder in (ROOT / "robo47", ROOT / "labkit", day.own):
        files += sorted(folder.rglob("*.py"))
    for path in [day.work, *files]:
        digest.update(path.read_bytes() if path.is_file() else b"")
    return f"{day.number} {digest.hexdigest()[:16]}"


def _read(path: Path) -> dict[str, Any]:
    try:
        known = json.loads(path.read_text("utf-8"))
    except (OSError, ValueError):
        return {}
    return known if isinstance(known, dict) else {}


def _write(path: Path, known: dict[str, Any]) -> None:
    try:
        path.parent.mkdir(exist_ok=True)
        path.write_text(json.dumps(dict(list(known.items())[-50:])), "utf-8")
    except OSError:
        return  # a read-only folder costs the memory, not the answer
