"""Which wall stands between a student's code and this machine (a stub until merged)."""

from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class Wall:
    """A wall by name, and what it does in a sentence."""

    name: str
    sentence: str


def wall() -> Wall:
    """Return the wall that stands here."""
    from robo47.checker.inside.landlock import fence  # noqa: F401

    return Wall("landlock", "files are closed to student code")


def in_container() -> bool:
    """Return whether this is a container, which is a wall of its own."""
    return any(Path(p).exists() for p in ("/.dockerenv", "/run/.containerenv"))
