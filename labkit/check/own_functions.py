"""A student's own functions of all days, each replaced by the library's where it fails.

    mine = load()
    mine.functions.solve_ik     the student's, if `make check` passes it
    mine.yours, mine.total      how many are theirs: "yours: 61 of 66"

The files run in this process, as `make run` runs them: they are the student's own, on
their own machine. Whether a function passes is the checker's word, in its sandbox.
"""

import sys
from collections.abc import Iterable
from dataclasses import dataclass, field
from types import ModuleType, SimpleNamespace

from labkit.check import states
from labkit.check.tasks import check_tasks
from labkit.lesson.day import Day, all_days
from labkit.sandbox.sandbox import Sandbox
from robo47 import capstone


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

    The checker is asked where its last word is not on the file as it is.
    """
    found = states.known(day)
    if len(found) < len(day.tasks):
        key = states.key_of(day)
        with Sandbox() as sandbox:
            found = states.remember(key, check_tasks(day, day.work, sandbox))
    return {task.id: found.get(task.id, "to do") for task in day.tasks}


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
