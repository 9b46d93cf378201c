"""Films of the lessons: what `w*/dayN/films.py` offers in FILMS, by picture."""

import sys
from collections.abc import Callable
from pathlib import Path

from labkit.inspector.recording import Recording
from labkit.lesson import folder
from labkit.lesson.day import Day, all_days
from robo47.errors import Robo47Error

LARGEST = 2_000_000  # bytes of a page's film


def films() -> dict[str, Callable[[], Recording]]:
    """Return what records the film beside each picture, by its name."""
    return {name: make for day in all_days() for name, make in films_of(day).items()}


def record(folder: Path) -> None:
    """Record every film into a folder; one that is too large for a page is an error."""
    folder.mkdir()
    for name, make in films().items():
        path = folder / f"{name}.html"
        path.write_text(make().page(name.replace("_", " ")), "utf-8")
        if path.stat().st_size > LARGEST:
            raise Robo47Error(f"the film {name} has {path.stat().st_size:,} bytes")


def films_of(day: Day) -> dict[str, Callable[[], Recording]]:
    """Return a day's films; {} where it has none."""
    if not folder.has(day, "films"):
        return {}
    source = str(day.source.parent)
    if source not in sys.path:  # where films.py finds the lab that it imports from
        sys.path.insert(0, source)
    found = folder.load(day, "films").FILMS
    return {f"day{day.number}_{name}": make for name, make in found.items()}
