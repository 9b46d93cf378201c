"""The pictures of a day's lesson: what `w*/dayN/figures.py` offers in FIGURES."""

import sys
from collections.abc import Callable
from typing import Any

from labkit.lesson import folder
from labkit.lesson.day import find_day
from robo47.errors import Robo47Error
from robo47.paths import shown


def lesson_figures(number: int, own: bool = False) -> dict[str, Callable[[], Any]]:
    """Return what draws each picture of a day: {"dayN_name": function, ...}.

    Args:
        number: of the day; {} where it has no pictures of its own.
        own: draw with the functions of the student's file, not with the kit's.
    """
    day = find_day(number)
    if not folder.has(day, "figures"):
        return {}
    source = str((day.work if own else day.source).parent)
    if source not in sys.path:  # where figures.py finds the lab that it imports from
        sys.path.insert(0, source)
    found = getattr(folder.load(day, "figures"), "FIGURES", None)
    if not isinstance(found, dict):
        raise Robo47Error(
            f"{shown(day.own)}/figures.py has no FIGURES: {{name: function}}"
        )
    return {f"day{number}_{name}": draw for name, draw in found.items()}
