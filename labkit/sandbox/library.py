"""Which modules of `robo47` a day's student code may import: those of earlier days.

They travel to the sandbox as source text, so nothing else of the kit is there to find.
"""

import ast
from functools import cache
from pathlib import Path

from labkit.lesson.day import Day, day_numbers, find_day
from robo47.errors import Robo47Error
from robo47.paths import ROOT, shown

KIT = ROOT / "robo47"


def library_of(day: Day) -> dict[str, str]:
    """Return the sources of what days before this one brought, and what that imports.

    Returns:
        By module name: {"robo47.se3": "...", ...}.

    Raises:
        Robo47Error: a manifest names a module that is not there, or one that imports an
            answer of this day. (A test looks at later days.)
    """
    earlier = [find_day(n) for n in day_numbers() if n < day.number]
    allowed = [name for d in earlier for name in d.library]
    found = {"kit": ""}  # a lab's first import, which leads to the kit's own Python
    waiting = list(allowed)
    while waiting:
        name = waiting.pop()
        if f"robo47.{name}" in found:
            continue
        if name in day.library:
            raise Robo47Error(
                f"{shown(file_of(name))} is an answer of day {day.number}, and the "
                "library of an earlier day imports it"
            )
        source, inner = _read(name)
        found[f"robo47.{name}"] = source
        waiting += inner
    return found


@cache
def _read(name: str) -> tuple[str, tuple[str, ...]]:
    """Return a module's source, and which modules of the kit it imports."""
    path = file_of(name)
    try:
        source = path.read_text("utf-8")
    except OSError:
        raise Robo47Error(
            f"a day's library names {shown(path)}, which is not there"
        ) from None
    inner: list[str] = []
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.ImportFrom) and node.module:
            names = [f"{node.module}.{alias.name}" for alias in node.names]
            inner += [n if file_of(_inner(n)).is_file() else node.module for n in names]
        elif isinstance(node, ast.Import):
            inner += [alias.name for alias in node.names]
    return source, tuple(filter(None, map(_inner, inner)))


def file_of(name: str) -> Path:
    """Return where a module is: "fast.ik" in robo47/fast/ik.py."""
    path = KIT.joinpath(*name.split("."))
    return path / "__init__.py" if path.is_dir() else path.with_suffix(".py")


def _inner(module: str) -> str:
    """Return "fast.ik" of robo47.fast.ik, and "" of what is not the kit's."""
    top, _, rest = module.partition(".")
    return rest if top == "robo47" else ""
