"""A week's manifest, `w*/week.toml`: the one place that knows which days there are.

Tables, documents, tests, the report, grading and the site ask `weeks()`. A folder that
looks like a week and has no manifest is refused by name: its days would be missing
everywhere, and nobody would say so.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

from labkit.lesson.table import load
from robo47.errors import Robo47Error
from robo47.paths import ROOT, shown


@dataclass(frozen=True)
class Soon:
    """A day that is announced and not written yet."""

    number: int
    title: str


@dataclass(frozen=True, kw_only=True)
class Week:
    """One week of the course: a folder of the clone."""

    number: int
    name: str  # "foundations"; the folder is w1-foundations
    title: str  # what the week is about, for its page
    days: tuple[int, ...]  # in order; each has its dayN/day.toml here
    soon: tuple[Soon, ...] = ()  # announced, not written
    robot: str = "panda_nohand"  # of `panda.load`, or a scene of this folder: "arm.xml"
    # The module of robo47 with USES (functions by day), library() and pick().
    capstone: str = ""
    extras: tuple[str, ...] = ()  # packages that student code finds: "scipy==1.17.1"
    folder: Path = field(repr=False)  # no entry

    @property
    def heading(self) -> str:
        """What it is called: "Week 1: foundations"."""
        return f"Week {self.number}: {self.name.replace('-', ' ')}"

    @property
    def manifests(self) -> dict[int, Path]:
        """The manifests of its days, by number."""
        return {n: self.folder / f"day{n}" / "day.toml" for n in self.days}


def weeks(root: Path = ROOT) -> list[Week]:
    """Return every week of a clone, in order.

    Raises:
        Robo47Error: a folder of a week without week.toml, or one that is not right.
    """
    found: dict[int, Week] = {}
    for folder in sorted(path for path in root.iterdir() if path.is_dir()):
        if not (folder / "week.toml").is_file():
            if re.match(r"w\d", folder.name) or any(folder.glob("day*/day.toml")):
                raise Robo47Error(
                    f"{shown(folder)}/ has no week.toml, so it is no week; make it "
                    "with make new, or give the folder a name without w and a digit"
                )
            continue
        week = load_week(folder)
        other = found.setdefault(week.number, week)
        if other is not week:
            places = f"{shown(other.folder)}, {shown(folder)}"
            raise Robo47Error(f"two weeks {week.number}: {places}")
    return [week for _, week in sorted(found.items())]


def find_week(number: int, root: Path = ROOT) -> Week:
    """Return a week by its number."""
    found = {week.number: week for week in weeks(root)}
    if number not in found:
        known = ", ".join(map(str, found)) or "none"
        raise Robo47Error(f"there is no week {number} yet; the kit has: {known}")
    return found[number]


def load_week(folder: Path) -> Week:
    """Return the week of a folder.

    Raises:
        Robo47Error: its week.toml cannot be read, or an entry is missing, empty, of a
            wrong type, unknown, or not that of the folder; says which.
    """
    manifest = folder / "week.toml"
    week: Week = load(Week, manifest, folder=folder)
    for fault in _faults(week):
        raise Robo47Error(shown(manifest) + fault)
    return week


def _faults(week: Week) -> Iterator[str]:
    """Say what is wrong between entries that are right by themselves."""
    wanted = f"w{week.number}-{week.name}"
    if week.folder.name != wanted:
        yield f": by number and name its folder is {wanted}, not {week.folder.name}"
    soon = [one.number for one in week.soon]
    for name, numbers in {"days": list(week.days), "soon": soon}.items():
        if numbers != sorted(set(numbers)):
            yield f": {name} are {numbers}; expected each once, in order"
    if both := set(week.days) & set(soon):
        yield f": day {min(both)} is in days, so it is not soon"
    there = {int(path.parent.name[3:]) for path in _day_folders(week.folder)}
    if missing := set(week.days) - there:
        yield f": day{min(missing)}/day.toml is not there"
    if unlisted := there - set(week.days):
        yield f": day{min(unlisted)}/ is there, and is not in days"


def _day_folders(folder: Path) -> list[Path]:
    found = folder.glob("day*/day.toml")
    return [path for path in found if re.fullmatch(r"day\d+", path.parent.name)]
