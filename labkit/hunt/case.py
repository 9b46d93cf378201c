"""A hunt as it stands: what was suspected, run, expected and repaired.

It is kept in `work/hunt/hunt.json`, beside the hunted script, so that it is committed
with it and a class can be graded. What the mistake is stands nowhere.
"""

import json
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

from labkit.base import store
from labkit.hunt.quarry import LEVELS, Quarry, drawn
from labkit.lesson.day import Day, find_day
from labkit.lesson.week import WORK
from robo47.errors import Robo47Error
from robo47.paths import shown

FOLDER = "hunt"
FILE = "hunt.json"


@dataclass
class Case:
    """A hunt.

    Attributes:
        day, level, seed: which mistake it is.
        known: names that were not drawn, since the student had met them.
        runs: of the hunted script. checks: of a repair.
        suspected: [function, what was expected of the run if it is the one], in order.
        found: whether it is over.
    """

    day: int
    level: int
    seed: int
    known: list[str] = field(default_factory=list)
    runs: int = 0
    checks: int = 0
    suspected: list[list[str]] = field(default_factory=list)
    found: bool = False

    @property
    def of_day(self) -> Day:
        """The day, from its manifest."""
        return find_day(self.day)

    @property
    def quarries(self) -> list[Quarry]:
        """What is to be found."""
        return drawn(self.of_day, self.level, self.seed, self.known)

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


def folder_of(day: Day) -> Path:
    """Return where hunts of a day's week are."""
    return day.folder / WORK / FOLDER


def script_of(day: Day, level: int) -> Path:
    """Return the hunted script of a day, or of its week's capstone."""
    name = day.source.name if level != 2 else f"{day.week.capstone}.py"
    return folder_of(day) / name


def read(folder: Path) -> Case | None:
    """Return the hunt in a folder, None where there is none.

    Raises:
        Robo47Error: its file is broken.
    """
    path = folder / FILE
    try:
        there: Any = json.loads(path.read_text("utf-8"))
        case = Case(**there)
        if case.level not in LEVELS or not isinstance(case.seed, int):
            raise ValueError
        return case
    except FileNotFoundError:
        return None
    except (OSError, ValueError, TypeError):
        raise Robo47Error(
            f"{shown(path)} is broken. Begin anew: make hunt ARGS=--anew"
        ) from None
