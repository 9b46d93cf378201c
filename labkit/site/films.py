"""Films of the lessons: what `w*/dayN/films.py` offers in FILMS, by picture."""

from collections.abc import Callable
from pathlib import Path

from labkit.inspector.recording import Recording
from labkit.lesson.day import all_days
from robo47.errors import Robo47Error

LARGEST = 2_000_000  # bytes of a page's film


def films() -> dict[str, Callable[[], Recording]]:
    """Return what records the film beside each picture, by its name."""
    some = (day.offered("films") for day in all_days())
    return {name: make for films in some for name, make in films.items()}


def record(into: Path) -> None:
    """Record every film into a folder; one that is too large for a page is an error."""
    into.mkdir()
    for name, make in films().items():
        path = into / f"{name}.html"
        path.write_text(make().page(name.replace("_", " ")), "utf-8")
        if path.stat().st_size > LARGEST:
            raise Robo47Error(f"the film {name} has {path.stat().st_size:,} bytes")
