"""The pictures of a day's lesson: what `w*/dayN/figures.py` offers in FIGURES."""

from collections.abc import Callable
from typing import Any

from labkit.lesson.day import find_day


def lesson_figures(number: int, own: bool = False) -> dict[str, Callable[[], Any]]:
    """Return what draws each picture of a day: {"dayN_name": function, ...}.

    Args:
        number: of the day; {} where it has no pictures of its own.
        own: draw with the functions of the student's file, not with the kit's.
    """
    day = find_day(number)
    figures = day.offered("figures", day.work if own else None)
    if figures and (small := getattr(day.module("figures"), "SMALL", None)):
        from labkit.figures.cards import card  # matplotlib is an extra

        draw, told = small
        figures[f"day{number}_small"] = lambda: card(draw(), told)
    return figures
