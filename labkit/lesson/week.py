"""A week's manifest, `w*/week.toml`: the one place that knows which days there are.

Tables, documents, tests, the report, grading and the site ask `weeks()`. A folder that
looks like a week and has no manifest is refused by name: its days would be missing
everywhere, and nobody would say so.

Also how a manifest is read, a week's or a day's: as a dataclass, whose fields are its
entries. What is missing, empty or misspelt is named.
"""

import dataclasses
import re
import tomllib
import typing
from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import lru_cache
from pathlib import Path
from typing import Any

from robo47.errors import Robo47Error
from robo47.paths import ROOT, shown

# A week's folder of the student's own labs; scripts/kit.py, Makefile and .gitignore,
# which read no Python of the kit's, name it too.
WORK = "work"
# The folder in which `make notebook` writes the labs with answers.
NOTEBOOKS = "notebooks"

_EXPECTED = {
    str: "a text",
    int: "a whole number",
    float: "a number",
    bool: "true or false",
    list: "a list",
    dict: "a table",
}


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
    title: str  # the subject of the week, for its page
    days: tuple[int, ...]  # the days in order; each has its dayN/day.toml here
    soon: tuple[Soon, ...] = ()  # announced, not written
    # `make view` opens this robot of `panda.load`, or a scene of this folder:
    # "arm.xml". Questions, lab runs and pictures are the Panda's; a row asks for
    # another robot with `Robot(path)`, a lab loads it in `main`; the check then runs
    # the lab with that robot, too.
    robot: str = "panda_nohand"
    # A module of robo47 with what `robo47.attempt` asks of it.
    capstone: str = ""
    extras: tuple[str, ...] = ()  # packages that student code finds: "scipy==1.17.1"
    # Patterns of the files that the student writes for the week and not for a day.
    retrospectives: tuple[str, ...] = ("docs/RETRO_*.md",)
    folder: Path = field(repr=False)  # no entry

    @property
    def heading(self) -> str:
        """The heading of the week: "Week 1: foundations"."""
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


def manifests(root: Path = ROOT) -> dict[int, Path]:
    """Return the manifests of a clone's days by number, in order.

    Raises:
        Robo47Error: a week is not right, or two have a day of the same number.
    """
    found: dict[int, Path] = {}
    for week in weeks(root):
        for number, path in week.manifests.items():
            other = found.setdefault(number, path)
            if other != path:
                raise Robo47Error(f"two days {number}: {shown(other)}, {shown(path)}")
    return dict(sorted(found.items()))


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
    folders = (path.parent.name for path in week.folder.glob("day*/day.toml"))
    there = {int(name[3:]) for name in folders if re.fullmatch(r"day\d+", name)}
    if missing := set(week.days) - there:
        yield f": day{min(missing)}/day.toml is not there"
    if unlisted := there - set(week.days):
        yield f": day{min(unlisted)}/ is there, and is not in days"


def entry(default: Any = dataclasses.MISSING, **how: Any) -> Any:
    """Return a field that is more than an entry of its name.

    Args:
        default: where the entry is left out; without one it has to be there.
        how: at="figure.path", an entry of an inner table; needed=True, it has to be
            there if its table is; least=2, how many a list holds.
    """
    return dataclasses.field(default=default, metadata=how)


def load(kind: Any, manifest: Path, **given: Any) -> Any:
    """Return a dataclass of a TOML file's entries, read again once it changes."""
    stat = manifest.stat() if manifest.is_file() else None
    return _load(kind, manifest, stat and (stat.st_mtime_ns, stat.st_size), **given)


@lru_cache(128)  # one command asks for the same manifests many times
def _load(kind: Any, manifest: Path, _state: Any, **given: Any) -> Any:
    try:
        return fill(kind, tomllib.loads(manifest.read_text("utf-8")), **given)
    except (OSError, ValueError) as error:
        raise Robo47Error(f"{shown(manifest)} cannot be read: {error}") from None
    except Robo47Error as error:
        raise Robo47Error(f"{shown(manifest)}{error}") from None


def fill(kind: Any, table: dict[str, Any], where: str = "", **given: Any) -> Any:
    """Return a dataclass with the entries of a table.

    Args:
        kind: its fields are texts, numbers, bools, tuples of texts or whole numbers,
            and tuples of dataclasses, whose tables are called by their `id` or place.
        table: as tomllib reads it.
        where: what to call it in an error, behind the file's name.
        given: fields that are no entries.

    Raises:
        Robo47Error: an entry is missing, empty, of a wrong type or unknown: a typo
            would be a rule that is off.
    """
    tables: dict[str, dict[str, dataclasses.Field[Any]]] = {"": {}}
    for wish in dataclasses.fields(kind):
        if wish.name not in given:
            inner, _, name = wish.metadata.get("at", wish.name).rpartition(".")
            tables.setdefault(inner, {})[name] = wish
    for inner, wanted in tables.items():
        entries = {} if inner else table
        if inner and inner in table:
            entries = _right(table[inner], inner, dict, where)
        place = f"{where}, {inner}" if inner else where
        for name, wish in wanted.items():
            needed = "needed" in wish.metadata and inner in ("", *table)
            needed = needed or wish.default is dataclasses.MISSING
            if name in entries or needed:
                least = wish.metadata.get("least", int(needed))
                value = _read(entries.get(name), name, wish.type, least, place)
                given[wish.name] = value
        known = wanted.keys() if inner else {*wanted, *tables} - {""}
        if unknown := sorted(set(entries) - known):
            there = ", ".join(sorted(known))
            why = f"no entry is called {unknown[0]}; there are {there}"
            raise Robo47Error(f"{place}: {why}")
    return kind(**given)


def _read(value: Any, name: str, kind: Any, least: int, where: str) -> Any:
    """Return an entry as its field holds it; None is one that is not there."""
    parts = typing.get_args(kind)
    if typing.get_origin(kind) is not tuple:
        value = _right(value, name, parts[0] if parts else kind, where)
        return float(value) if float in (kind, *parts) else value
    tables = dataclasses.is_dataclass(parts[0])
    right: Any = dict if tables else parts[0]
    found = _right([] if tables and value is None else value, name, list, where)
    if len(found) < least:
        few = f"has too few entries ({len(found)}); expected at least {least}"
        raise Robo47Error(f"{where}: {name} {'is empty' if tables else few}")
    for one in found:
        blank = isinstance(one, str) and not one.strip()
        if not isinstance(one, right) or isinstance(one, bool) or blank:
            what = _EXPECTED[right].partition(" ")[2]
            raise Robo47Error(f"{where}: {name} holds {one!r}, not a {what}")
    if not tables:
        return tuple(" ".join(o.split()) if isinstance(o, str) else o for o in found)
    names = (f"{where}, {name} {t.get('id', i)}" for i, t in enumerate(found, 1))
    return tuple(fill(parts[0], *pair) for pair in zip(found, names, strict=True))


def _right(value: Any, name: str, kind: type, where: str) -> Any:
    """Return a value of the right type that is not empty."""
    # bool passes for int, and an integer is a fine float
    right = isinstance(value, (int, float) if kind is float else kind)
    if not right or isinstance(value, bool) != (kind is bool) or value in ("", {}):
        raise Robo47Error(f"{where}: {name} is {value!r}; expected {_EXPECTED[kind]}")
    return value
