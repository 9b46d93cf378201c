"""The pictures of a day's lesson: what `w*/dayN/figures.py` offers in FIGURES."""

import sys
from collections.abc import Callable
from typing import Any

from labkit.figures.sheet import thumbnail
from labkit.lesson import folder
from labkit.lesson.day import find_day
from robo47.errors import Robo47Error
from robo47.paths import shown


def lesson_figures(number: int, own: bool = False) -> dict[str, Callable[[], Any]]:
    """Return what draws each picture of a day.

    Args:
        number: of the day.
        own: draw with the functions of the student's file, not with the kit's.

    Returns:
        {"dayN_name": function that returns a PIL image, ...}; {} where the day has
        no pictures of its own.

    Raises:
        Robo47Error: no such day, or its figures.py offers no FIGURES.
    """
    day = find_day(number)
    if not folder.has(day, "figures"):
        return {}
    source = str((day.work if own else day.source).parent)
    if source not in sys.path:  # where figures.py finds the lab that it imports from
        sys.path.insert(0, source)
    lesson = folder.load(day, "figures")
    found = getattr(lesson, "FIGURES", None)
    if not isinstance(found, dict):
        raise Robo47Error(
            f"{shown(day.own)}/figures.py has no FIGURES: {{name: function}}"
        )
    figures = {f"day{number}_{name}": draw for name, draw in found.items()}
    if hasattr(lesson, "SMALL"):  # a picture, and the part of it that a table shows
        name, *part = lesson.SMALL
        figures[f"day{number}_small"] = lambda: thumbnail(found[name](), *part)
    return figures
