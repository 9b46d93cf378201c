"""What a closed function of a hunted script does when it is called.

    from labkit.hunt.hunted import hunted
    return hunted("mass_matrix", J_space, G, armature)

It is the kit's own, or the one with the mistake. What somebody wrote anew in the hunted
script is called in its place, by the other functions as well.
"""

import sys
from collections.abc import Mapping
from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import Any

from labkit.base import cli
from labkit.hunt import case as cases
from labkit.lesson.day import Day, days_of
from labkit.lesson.lab_module import load_lab
from robo47.errors import Robo47Error

if not {"--no-log", "--try"} & set(sys.argv):
    sys.argv.append("--no-log")  # a hunt's numbers are nobody's


class Hunted:
    """The functions of one hunted script, looked up when the first is called."""

    def __init__(self) -> None:
        """Know nothing yet: the script is still being read."""
        self._labs: dict[int, ModuleType] = {}
        self._owner: dict[str, int] = {}

    def __call__(self, name: str, *arguments: Any) -> Any:
        """Call a function by name."""
        return self._function(name, sys._getframe(1).f_globals)(*arguments)

    def _function(self, name: str, script: Mapping[str, Any]) -> Any:
        if not self._labs:
            self._begin(script)
        return vars(self._labs[self._owner[name]])[name]

    def _begin(self, script: Mapping[str, Any]) -> None:
        """Load the labs, put the mistake in, and what the script has anew."""
        case = cases.read(Path(script["__file__"]).parent)
        if case is None:
            raise Robo47Error("this hunt is not there any more: make hunt ARGS=--anew")
        day = case.of_day
        days = [day] if case.level != 2 else _before(day)
        for other in days:
            lab = load_lab(other.source)
            self._labs[other.number] = lab
            for task in other.tasks:
                for name in task.functions:
                    self._owner.setdefault(name, other.number)
        for one in case.quarries:
            vars(self._labs[one.day])[one.function] = one.code
        for name, number in self._owner.items():
            own = script.get(name)
            if own is not None and "hunted" not in own.__code__.co_names:
                vars(self._labs[number])[name] = own

    def capstone(self, script: Mapping[str, Any]) -> int:
        """Do the week's capstone by the script's functions, and by right ones."""
        from labkit.check.own_functions import capstone_of

        case = cases.read(Path(script["__file__"]).parent)
        if case is None:
            raise Robo47Error("this hunt is not there any more: make hunt ARGS=--anew")
        capstone = capstone_of(case.of_day.week)
        right = capstone.library()
        names = [n for names in capstone.USES.values() for n in names if n in script]
        fns = SimpleNamespace(**{**vars(right), **{n: script[n] for n in names}})
        print(capstone.HEAD)
        try:
            print(capstone.row("these functions", capstone.attempt(fns)))
        except Exception as error:
            print(f"these functions: it stops with {type(error).__name__}: {error}")
        print(capstone.row("right ones", capstone.attempt(right)))
        return cli.EXIT_OK


def _before(day: Day) -> list[Day]:
    return [other for other in days_of(day.week) if other.number <= day.number]


hunted = Hunted()
