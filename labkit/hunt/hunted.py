"""The calls of closed functions in a hunted script.

    from labkit.hunt.hunted import Lab, hunted
    return hunted("mass_matrix", J_space, G, armature)

It is the kit's own, or the one with the mistake. What somebody wrote anew in the hunted
script is called in its place, by the other functions as well. A check whose words name
a function would give the hunt away: `Lab` counts these, and shows the others.
"""

import re
import sys
import traceback
from collections.abc import Mapping
from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import Any

from labkit.base import cli
from labkit.hunt import case as cases
from labkit.hunt.capstone_trials import attempt
from labkit.lesson import lab as lessons
from labkit.lesson.lab_module import load_lab
from labkit.lesson.metric import Metric
from robo47.errors import Robo47Error

if not {"--no-log", "--try"} & set(sys.argv):
    sys.argv.append("--no-log")  # a hunt's numbers are nobody's


class Lab(lessons.Lab):
    """A lab's run that keeps to itself which function a check names."""

    def __init__(self, file: str, about: str | None) -> None:
        """Read the command line and the day's manifest, as every lab does."""
        super().__init__(file, about)
        self._quiet: list[bool] = []  # the results of the checks that are not shown
        names = "|".join(name for task in self.day.tasks for name in task.functions)
        self._names = re.compile(rf"\b({names})\b")

    def _judge(self, name: str, wanted: Metric, value: float) -> None:
        if self._names.search(name):
            self._quiet.append(wanted.passes(value))
        else:
            super()._judge(name, wanted, value)

    def finish(self) -> int:
        """Say how many of the checks that are not shown fail, then the rest."""
        bad = self._quiet.count(False)
        if self._quiet and not self.trial:
            says = f"{bad} of {len(self._quiet)} checks that name a function fail"
            print(f"\n  {cli.verdict(not bad)}  {says}")
            self.failed += [says] if bad else []
        return super().finish()


class Hunted:
    """The functions of one hunted script, looked up when the first is called."""

    def __init__(self) -> None:
        """Know nothing yet: the script is still being read."""
        self._labs: dict[int, ModuleType] = {}
        self._owner: dict[str, int] = {}

    def __call__(self, name: str, *arguments: Any) -> Any:
        """Call a function by name.

        What stops in the kit's lines is told without them and without its name: they
        are the answer.
        """
        script = sys._getframe(1).f_globals
        function = self._function(name, script)
        try:
            return function(*arguments)
        except Exception as error:
            last = traceback.extract_tb(error.__traceback__)[-1]
            if last.filename == script["__file__"]:
                raise
            kind = type(error).__name__
            raise Robo47Error(f"a closed function stops: {kind}: {error}") from None

    def _function(self, name: str, script: Mapping[str, Any]) -> Any:
        if not self._labs:
            self._begin(script)
        if name not in self._owner:
            raise Robo47Error(f"this kit has no {name}: make hunt ARGS=--anew")
        return vars(self._labs[self._owner[name]])[name]

    def _begin(self, script: Mapping[str, Any]) -> None:
        """Load the labs, put the mistake in, and what the script has anew."""
        case = cases.read(Path(script["__file__"]).parent)
        if case is None:
            raise Robo47Error("this hunt is not there any more: make hunt ARGS=--anew")
        day = case.of_day
        for other in cases.days_hunted(day, case.level):
            lab = load_lab(other.source)
            self._labs[other.number] = lab
            for task in other.tasks:
                for name in task.functions:
                    self._owner.setdefault(name, other.number)
        for one in case.mistakes:
            vars(self._labs[one.day])[one.function] = one.code
        for name, number in self._owner.items():
            own = script.get(name)
            if own is not None and "hunted" not in own.__code__.co_names:
                vars(self._labs[number])[name] = own

    def capstone(self, script: Mapping[str, Any]) -> int:
        """Run the week's capstone with the script's functions, and with right ones."""
        from labkit.check.own_functions import capstone_of

        case = cases.read(Path(script["__file__"]).parent)
        if case is None:
            raise Robo47Error("this hunt is not there any more: make hunt ARGS=--anew")
        capstone = capstone_of(case.of_day.week)
        right = capstone.library()
        names = [n for names in capstone.USES.values() for n in names if n in script]
        fns = SimpleNamespace(**{**vars(right), **{n: script[n] for n in names}})
        print(capstone.HEAD)
        for who, these in (("these functions", fns), ("right ones", right)):
            found = attempt(capstone, these, who)
            print(found.line if found.done else cli.wrapped(found.line, "  "))
        return cli.EXIT_OK


hunted = Hunted()
