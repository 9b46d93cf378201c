"""The hunted script: a lab, or a week's capstone, whose functions are closed.

A closed function has its docstring and no lines of its own. It can be called, printed
and compared; who suspects it writes it anew in its place.
"""

import ast
from collections.abc import Iterable
from pathlib import Path

from labkit.lesson.day import Day
from labkit.lesson.lab_module import read_script
from labkit.lesson.starter import function_lines

MARK = "# closed: suspect it? Write it anew here"
IMPORT = "from labkit.hunt.hunted import {}"
KIT = "import kit  # noqa: F401 (goes on in the kit's own Python)"
LAB = "from robo47.lesson.lab import Lab"
CAPSTONE = '''"""{name} of week {week}, by functions of which one is wrong.

    make hunt ARGS=--run      do it
    make hunt                 say which function you suspect
"""

from __future__ import annotations

{kit}
import numpy as np
{imports}

from robo47 import cli


{functions}


def main() -> int:
    """Do it with these functions, and with right ones."""
    return hunted.capstone(globals())


if __name__ == "__main__":
    cli.run(main)
'''


def closed_lab(day: Day) -> str:
    """Return a day's lab with its functions closed."""
    text = read_script(day.source)
    lines = text.splitlines()
    for name in _functions(day):
        start, end, own = function_lines("\n".join(lines), name)
        lines[start:end] = closed(own, name)
    lines.remove(LAB)
    lines.insert(lines.index(KIT) + 1, IMPORT.format("Lab, hunted"))
    return "\n".join(lines) + "\n"


def closed_capstone(day: Day, days: Iterable[Day], name: str) -> str:
    """Return a script that does a week's capstone by closed functions.

    Args:
        day: the last one whose functions it has.
        days: those whose functions the capstone calls.
        name: of the capstone.
    """
    from labkit.check.own_functions import capstone_of

    uses = capstone_of(day.week).USES
    parts = []
    for other in days:
        text = read_script(other.source)
        for function in _functions(other):
            if function in uses.get(other.number, ()):
                own = function_lines(text, function)[2]
                parts.append("\n".join(closed(own, function)))
    return CAPSTONE.format(
        name=name[0].upper() + name[1:],
        week=day.week.number,
        kit=KIT,
        imports=IMPORT.format("hunted"),
        functions="\n\n\n".join(parts),
    )


def closed(lines: list[str], name: str) -> list[str]:
    """Return a function's lines without what stands below its docstring."""
    tree = ast.parse("\n".join(lines))
    function = tree.body[0]
    assert isinstance(function, ast.FunctionDef)
    first = function.body[0]
    given = [one.arg for one in function.args.args]
    kept = lines[: first.end_lineno] if ast.get_docstring(function) else lines[:1]
    call = ", ".join([f'"{name}"', *given])
    return [*kept, f"    return hunted({call})  {MARK}"]


def is_closed(own: list[str]) -> bool:
    """Return whether a function's lines are still those of a closed one."""
    return any(MARK in line for line in own)


def opened(text: str, names: Iterable[str]) -> dict[str, str]:
    """Return the functions that somebody wrote anew in a hunted script, by name."""
    found = {}
    for name in names:
        own = function_lines(text, name)[2]
        if own and not is_closed(own):
            found[name] = "\n".join(own)
    return found


def closed_names(script: Path, days: Iterable[Day]) -> tuple[list[str], list[str]]:
    """Return the functions of a hunted script: those closed, those written anew."""
    text = script.read_text("utf-8-sig", errors="replace")
    asked = [name for day in days for name in _functions(day)]
    there = [name for name in asked if f"def {name}(" in text]
    anew = opened(text, there)
    return [name for name in there if name not in anew], list(anew)


def _functions(day: Day) -> list[str]:
    return [name for task in day.tasks for name in task.functions]


def kit_beside(day: Day) -> str:
    """Return `kit.py` for a folder that lies one deeper than a student's lab."""
    text = (Path(day.source).parent / "kit.py").read_text("utf-8")
    return text.replace("_folder, os.pardir, os.pardir,", "_folder, *3 * [os.pardir],")
