"""A week's manifest, `week.toml`: its days, their tasks, and what a day hands in.

One file that the starter, the checker, the hints and the report all read. Whatever is
missing or empty in it is found here, at loading, and named.
"""

import tomllib
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from robo47.errors import Robo47Error
from robo47.paths import ROOT, shown


@dataclass(frozen=True)
class Task:
    """One gap of the starter.

    Attributes:
        id: day.task, such as "1.4"; the same in code, output and worksheet.
        title: what it is about.
        functions: what the student writes.
        needs: ids of the tasks that its functions may call.
        read: the section to re-read.
        hints: questions and pointers, in the order to give them.
        without: NumPy functions whose use misses the point of it.
    """

    id: str
    title: str
    functions: tuple[str, ...]
    needs: tuple[str, ...]
    read: str
    hints: tuple[str, ...]
    without: tuple[str, ...]


@dataclass(frozen=True)
class Metric:
    """A row that the log must hold, and the range of its value; None is no bound."""

    check: str
    metric: str
    max: float | None = None
    min: float | None = None

    @property
    def limit(self) -> str:
        """The range as people write it: "at most 1e-08"."""
        parts = [] if self.min is None else [f"at least {self.min:g}"]
        parts += [] if self.max is None else [f"at most {self.max:g}"]
        return " and ".join(parts)

    def passes(self, value: float) -> bool:
        """Return whether a value is within the range; NaN never is."""
        high = self.max is None or value <= self.max
        return value == value and high and (self.min is None or value >= self.min)


@dataclass(frozen=True)
class Day:
    """One day of the course; paths are relative to the week's folder.

    Attributes:
        number: of the day, from 1 to 47.
        title: what it is about.
        script: file name of the lab script, in `src/` and in `work/`.
        guide: the lab guide.
        minutes: how long it takes.
        readings: what to read and watch.
        tasks: in the order to do them.
        figure: the student's picture.
        kit_figures: pictures of the kit's own that do not count as the student's.
        worksheet: the student's worksheet.
        terms: what the worksheet's glossary defines.
        drawings: how many drawings it holds.
        questions: how many questions it asks.
        metrics: rows of the log.
        folder: the week's folder.
    """

    number: int
    title: str
    script: str
    guide: str
    minutes: int
    readings: tuple[str, ...]
    tasks: tuple[Task, ...]
    figure: str
    kit_figures: tuple[str, ...]
    worksheet: str
    terms: tuple[str, ...]
    drawings: int
    questions: int
    metrics: tuple[Metric, ...]
    folder: Path

    @property
    def source(self) -> Path:
        """The complete script."""
        return self.folder / "src" / self.script

    @property
    def work(self) -> Path:
        """The student's script."""
        return self.folder / "work" / self.script

    def task(self, task_id: str) -> Task:
        """Return a task by its id.

        Raises:
            Robo47Error: the day has no such task; names those it has.
        """
        for task in self.tasks:
            if task.id == task_id:
                return task
        known = ", ".join(task.id for task in self.tasks)
        raise Robo47Error(f"day {self.number} has no task {task_id}; it has {known}")


def find_day(number: int, root: Path = ROOT) -> Day:
    """Return a day, from whichever week has it.

    Args:
        number: of the day.
        root: the clone; its manifests are `w*/week.toml`.

    Raises:
        Robo47Error: no week has that day, or a manifest is not right.
    """
    days = {
        day.number: day
        for manifest in sorted(root.glob("w*/week.toml"))
        for day in load_week(manifest)
    }
    if number not in days:
        known = ", ".join(str(n) for n in sorted(days)) or "none"
        raise Robo47Error(f"there is no day {number} yet; the kit has: {known}")
    return days[number]


def find_task(task_id: str, root: Path = ROOT) -> tuple[Day, Task]:
    """Return a task and its day.

    Args:
        task_id: such as "1.4".
        root: as `find_day`.

    Raises:
        Robo47Error: not an id, or no such day or task.
    """
    number = task_id.partition(".")[0]
    if not number.isdecimal():
        raise Robo47Error(f"{task_id!r} is no task; expected an id such as 1.4")
    day = find_day(int(number), root)
    return day, day.task(task_id)


def all_days(root: Path = ROOT) -> list[Day]:
    """Return every day of the course, in order."""
    return [d for p in sorted(root.glob("w*/week.toml")) for d in load_week(p)]


def load_week(manifest: Path) -> list[Day]:
    """Return the days of a manifest.

    Args:
        manifest: path of a `week.toml`.

    Raises:
        Robo47Error: it cannot be read, or an entry is missing, empty or of a wrong
            type; says which.
    """
    try:
        data = tomllib.loads(manifest.read_text("utf-8"))
    except (OSError, ValueError) as error:
        raise Robo47Error(f"{shown(manifest)} cannot be read: {error}") from None
    entries = _Entries(data, shown(manifest))
    return [_day(day, manifest.parent) for day in entries.tables("days")]


class _Entries:
    """A table of the manifest whose entries are fetched by name and type."""

    def __init__(self, table: dict[str, Any], where: str) -> None:
        self.table, self.where = table, where

    def get(self, name: str, kind: type) -> Any:
        value = self.table.get(name)
        # bool passes for int, and an integer is a fine float
        right = isinstance(value, (int, float) if kind is float else kind)
        if not right or isinstance(value, bool) or value in ("", {}):
            raise Robo47Error(
                f"{self.where}: {name} is {value!r}; expected a {kind.__name__}"
            )
        return value

    def texts(self, name: str, *, at_least: int = 1) -> tuple[str, ...]:
        values = self.get(name, list) if at_least else self.table.get(name, [])
        if len(values) < at_least:
            raise Robo47Error(
                f"{self.where}: {name} has {len(values)} entries; expected {at_least}"
            )
        for value in values:
            if not isinstance(value, str) or not value.strip():
                raise Robo47Error(f"{self.where}: {name} holds {value!r}, not a text")
        return tuple(" ".join(value.split()) for value in values)

    def tables(self, name: str) -> list["_Entries"]:
        found = self.get(name, list)
        if not found:
            raise Robo47Error(f"{self.where}: {name} is empty")
        return [
            _Entries(table, f"{self.where}, {name} {table.get('id', i + 1)}")
            for i, table in enumerate(found)
        ]

    def inner(self, name: str) -> "_Entries":
        return _Entries(self.get(name, dict), f"{self.where}, {name}")


def _day(entries: _Entries, folder: Path) -> Day:
    number = entries.get("number", int)
    figure, worksheet = entries.inner("figure"), entries.inner("worksheet")
    tasks = tuple(_task(table, number) for table in entries.tables("tasks"))
    _check_order(tasks, entries.where)
    return Day(
        number=number,
        title=entries.get("title", str),
        script=entries.get("script", str),
        guide=entries.get("guide", str),
        minutes=entries.get("minutes", int),
        readings=entries.texts("readings"),
        tasks=tasks,
        figure=figure.get("path", str),
        kit_figures=figure.texts("not_a_copy_of", at_least=0),
        worksheet=worksheet.get("path", str),
        terms=worksheet.texts("terms"),
        drawings=worksheet.get("drawings", int),
        questions=worksheet.get("questions", int),
        metrics=tuple(
            Metric(row.get("check", str), row.get("metric", str), row.get("max", float))
            for row in entries.tables("metrics")
        ),
        folder=folder,
    )


def _task(entries: _Entries, day: int) -> Task:
    task = Task(
        id=entries.get("id", str),
        title=entries.get("title", str),
        functions=entries.texts("functions"),
        needs=entries.texts("needs", at_least=0),
        read=entries.get("read", str),
        hints=entries.texts("hints", at_least=2),
        without=entries.texts("without", at_least=0),
    )
    if not task.id.startswith(f"{day}."):
        raise Robo47Error(f"{entries.where}: id {task.id} is not one of day {day}")
    return task


def _check_order(tasks: tuple[Task, ...], where: str) -> None:
    """Refuse an id that is used twice, and a need that is no earlier task."""
    earlier: set[str] = set()
    for task in tasks:
        if task.id in earlier:
            raise Robo47Error(f"{where}: two tasks have the id {task.id}")
        for need in task.needs:
            if need not in earlier:
                why = f"{task.id} needs {need}, which is no earlier task"
                raise Robo47Error(f"{where}: {why}")
        earlier.add(task.id)
