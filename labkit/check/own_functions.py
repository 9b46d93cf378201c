"""A student's own functions of a week, each replaced by the library's where it fails.

    mine = load()               of the last week that has a capstone and is begun
    mine.functions.NAME         the student's, if `make check` passes it
    mine.yours, mine.total      all that pass, and how many the days ask for
    counted(asked, own)         how many are theirs, as every face of the kit counts

The files run in this process, as `make run` runs them: they are the student's own, on
their own machine. Whether a function passes is the checker's word, in its sandbox.
"""

import importlib
import sys
from collections.abc import Collection, Mapping
from dataclasses import dataclass, field
from types import ModuleType, SimpleNamespace
from typing import NamedTuple

from labkit.check import memory
from labkit.check.tasks import check_tasks
from labkit.lesson.day import Day, days_of, find_day, started_day
from labkit.lesson.week import Week, weeks
from labkit.sandbox.sandbox import Sandbox
from robo47.errors import Robo47Error
from robo47.paths import shown

# `robo47.attempt` asks these of a capstone's module.
ASKED = (
    "NAME", "THING", "GOAL", "USES", "HEAD",
    "library", "attempt", "row", "summary", "film",
)  # fmt: skip


class OwnCount(NamedTuple):
    """The number of the student's own functions, and of all functions."""

    own: int
    of: int

    @property
    def all(self) -> bool:
        """Every function is the student's own."""
        return self.own == self.of

    def __str__(self) -> str:
        """Return "46 of 47"."""
        return f"{self.own} of {self.of}"


def counted(
    asked: Mapping[int, Collection[str]], own: Mapping[int, Collection[str]]
) -> OwnCount:
    """Count the functions that are the student's own: those that pass the check.

    The capstone, the proof page and its card all count by this function. A function
    that passes counts also where the sandbox cannot call it and the library's runs.

    Args:
        asked: the names that are counted, by day, such as a capstone's USES.
        own: the names that pass in the student's file, by day.
    """
    names = {(day, name) for day, some in asked.items() for name in some}
    passing = {(day, name) for day, some in own.items() for name in some}
    return OwnCount(len(names & passing), len(names))


@dataclass
class Mine:
    """The week's functions, and whose they are."""

    functions: SimpleNamespace  # the functions by name, ready for the capstone
    own: dict[int, list[str]] = field(default_factory=dict)  # the student's, by day
    # (day, name, why) of those that are the library's.
    replaced: list[tuple[int, str, str]] = field(default_factory=list)

    @property
    def yours(self) -> list[str]:
        """The names of the functions that are the student's own."""
        return [name for some in self.own.values() for name in some]

    @property
    def total(self) -> int:
        """The number of functions of the days, called by the capstone or not."""
        return len(self.yours) + len(self.replaced)


def capstone_week() -> Week:
    """Return the week whose capstone is meant where none is named: the last begun.

    Raises:
        Robo47Error: no week has one.
    """
    having = [week for week in weeks() if week.capstone]
    if not having:
        raise Robo47Error("no week has a capstone")
    begun = [w for w in having if w.number <= find_day(started_day()).week.number]
    return (begun or having)[-1]


def capstone_of(week: Week) -> ModuleType:
    """Return the module of a week's capstone.

    Raises:
        Robo47Error: it has none, and names the weeks that have; or the module is not
            there, or lacks something that `robo47.attempt` asks of it.
    """
    if not week.capstone:
        having = ", ".join(str(w.number) for w in weeks() if w.capstone)
        raise Robo47Error(
            f"week {week.number} has no capstone yet; weeks with one: {having}"
        )
    name = f"robo47.{week.capstone}"
    where = shown(week.folder / "week.toml")
    try:
        capstone = importlib.import_module(name)
    except ModuleNotFoundError as error:
        raise Robo47Error(f"{where}: capstone {week.capstone}: {error}") from None
    if missing := [word for word in ASKED if not hasattr(capstone, word)]:
        raise Robo47Error(
            f"{where}: {name} has no {', '.join(missing)}; what a capstone needs "
            "stands in robo47/attempt.py"
        )
    return capstone


def load(week: Week | None = None) -> Mine:
    """Return the student's functions that a week's capstone is made of.

    A name belongs to the day that the capstone's USES has it under: another day's
    function of that name takes no part.

    Args:
        week: whose; by default as `capstone_week`.

    Raises:
        Robo47Error: the week has no capstone.
    """
    week = week or capstone_week()
    capstone = capstone_of(week)
    owner = {name: day for day, names in capstone.USES.items() for name in names}
    earlier = [find_day(n) for n in sorted(set(capstone.USES) - set(week.days))]
    mine = Mine(capstone.library())
    for day in [*earlier, *days_of(week)]:
        why = statuses(day)
        module = _module(day) if "passed" in why.values() else None
        for task in day.tasks:
            passed = why[task.id] == "passed"
            told = "does not load here" if passed else why[task.id]
            for name in task.functions:
                if owner.get(name, day.number) != day.number:
                    continue
                if passed and hasattr(module, name):
                    setattr(mine.functions, name, getattr(module, name))
                    mine.own.setdefault(day.number, []).append(name)
                else:
                    mine.replaced.append((day.number, name, told))
    return mine


def statuses(day: Day) -> dict[str, str]:
    """Return how each task of a day stands: "passed", "wrong", "to do" and so on.

    The checker is asked where its last word is not on the file as it is.
    """
    found = memory.task_states(day)
    if len(found) < len(day.tasks):
        key = memory.key_of(day)
        with Sandbox() as sandbox:
            found = memory.remember(key, check_tasks(day, day.work, sandbox))
    return {task.id: found.get(task.id, "to do") for task in day.tasks}


def _module(day: Day) -> ModuleType | None:
    """Return a student's file as a module, or None where it does not load here."""
    module = ModuleType(day.work.stem)
    module.__file__ = str(day.work)
    sys.modules[module.__name__] = module  # the module may import itself while it loads
    sys.path.insert(0, str(day.work.parent))
    try:
        code = compile(day.work.read_bytes(), str(day.work), "exec")
        exec(code, vars(module))
    except Exception:  # the sandbox could load it; here something else is in the way
        return None
    finally:
        sys.path.remove(str(day.work.parent))
    return module
