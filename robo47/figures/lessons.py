"""The pictures of a day's lesson: what `w*/dayN/figures.py` offers in FIGURES."""

import importlib.util
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

from robo47.errors import Robo47Error
from robo47.paths import shown
from robo47.week import Day, find_day


def lesson_figures(number: int) -> dict[str, Callable[[], Any]]:
    """Return what draws each picture of a day.

    Args:
        number: of the day.

    Returns:
        {"day1_order": function that returns a PIL image, ...}; {} where the day has
        no pictures of its own.

    Raises:
        Robo47Error: no such day, or its figures.py offers no FIGURES.
    """
    day = find_day(number)
    path = figures_file(day)
    if not path.exists():
        return {}
    name = f"day{number}_figures"
    spec = importlib.util.spec_from_file_location(name, path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    source = str(day.source.parent)
    if source not in sys.path:  # pictures are drawn with the lab's own functions
        sys.path.insert(0, source)
    spec.loader.exec_module(module)
    if not isinstance(getattr(module, "FIGURES", None), dict):
        raise Robo47Error(f"{shown(path)} has no FIGURES: {{name: function}}")
    return {f"day{number}_{key}": draw for key, draw in module.FIGURES.items()}


def figures_file(day: Day) -> Path:
    """Return where a day's pictures are described, in its folder or beside its lab."""
    new = day.folder / f"day{day.number}" / "figures.py"
    old = day.source.with_name(f"day{day.number}_figures.py")
    return old if old.exists() and not new.exists() else new
