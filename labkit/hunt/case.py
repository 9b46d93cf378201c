"""A hunt as it stands: what was suspected, run, expected and repaired.

It is kept in `work/hunt/hunt.json`, beside the hunted script, so that it is committed
with it and a class can be graded. What the mistake is stands there as a hash alone.
"""

import json
from dataclasses import asdict, dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

from labkit.base import store
from labkit.hunt.mistakes import LEVELS, HiddenMistake, mark_of, marked, sample
from labkit.lesson.day import Day, days_of, find_day
from labkit.lesson.week import WORK, weeks
from robo47.errors import Robo47Error
from robo47.paths import shown

FOLDER = "hunt"
FILE = "hunt.json"


@dataclass
class Case:
    """A hunt.

    Attributes:
        day, level, seed: which mistake it is.
        marks: of what is to be found, so that a newer kit goes on with the same.
        runs: of the hunted script. checks: of a repair.
        suspected: [function, what was expected of the run if it is the one], in order.
        ended: "" while it goes on; how it ended, one of `labkit.hunt.tally.ENDS`.
    """

    day: int
    level: int
    seed: int
    marks: list[str] = field(default_factory=list)
    runs: int = 0
    checks: int = 0
    suspected: list[list[str]] = field(default_factory=list)
    ended: str = ""

    @property
    def of_day(self) -> Day:
        """The day, from its manifest."""
        return find_day(self.day)

    @cached_property
    def mistakes(self) -> list[HiddenMistake]:
        """The mistakes that are to be found."""
        if self.marks:
            return marked(self.of_day, self.level, self.seed, self.marks)
        return sample(self.of_day, self.level, self.seed)

    @property
    def guilty(self) -> set[str]:
        """The functions that are wrong."""
        return {one.function for one in self.mistakes}

    @property
    def named(self) -> bool:
        """All wrong functions were suspected."""
        return self.guilty <= {function for function, _ in self.suspected}

    @property
    def script(self) -> Path:
        """The hunted script."""
        return script_of(self.of_day, self.level)

    def save(self) -> None:
        """Write it down."""
        text = json.dumps(asdict(self), indent=1) + "\n"
        path = folder_of(self.of_day) / FILE
        path.parent.mkdir(parents=True, exist_ok=True)
        store.replace(path, text.encode())


def draw(day: Day, level: int, seed: int, known: list[str]) -> Case:
    """Return a hunt that begins.

    Args:
        day, level, seed: as `mistakes.sample` takes them.
        known: names of mistakes that are not drawn.
    """
    found = sample(day, level, seed, known)
    return Case(day.number, level, seed, [mark_of(one, level, seed) for one in found])


def folder_of(day: Day) -> Path:
    """Return where hunts of a day's week are."""
    return day.folder / WORK / FOLDER


def script_of(day: Day, level: int) -> Path:
    """Return the hunted script of a day, or of its week's capstone."""
    name = day.source.name if level != 2 else f"{day.week.capstone}.py"
    return folder_of(day) / name


def days_hunted(day: Day, level: int) -> list[Day]:
    """Return the days whose functions a hunt is about."""
    if level != 2:
        return [day]
    return [other for other in days_of(day.week) if other.number <= day.number]


def latest() -> Case | None:
    """Return the hunt that was worked on last, of all weeks; None without one.

    Raises:
        Robo47Error: its file is broken.
    """
    files = [week.folder / WORK / FOLDER / FILE for week in weeks()]
    there = [path for path in files if path.is_file()]
    if not there:
        return None
    return read(max(there, key=lambda path: path.stat().st_mtime).parent)


def read(folder: Path) -> Case | None:
    """Return the hunt in a folder, None where there is none.

    Raises:
        Robo47Error: its file is broken.
    """
    path = folder / FILE
    try:
        return parsed(path.read_bytes())
    except FileNotFoundError:
        return None
    except (OSError, ValueError, TypeError):
        raise Robo47Error(
            f"{shown(path)} is broken. Begin anew: make hunt ARGS=--anew"
        ) from None


def parsed(data: bytes) -> Case:
    """Return a hunt of its file's content.

    Raises:
        ValueError, TypeError: it is none.
    """
    there: Any = json.loads(data)
    case = Case(**there)
    numbers = (case.day, case.level, case.seed, case.runs, case.checks)
    if case.level not in LEVELS or not all(type(one) is int for one in numbers):
        raise ValueError
    lists = [case.marks, *case.suspected]
    if not all(isinstance(one, list) for one in lists) or any(
        len(one) != 2 for one in case.suspected
    ):
        raise ValueError
    words = [*case.marks, *(word for pair in case.suspected for word in pair)]
    if not all(isinstance(word, str) for word in [*words, case.ended]):
        raise ValueError
    return case
