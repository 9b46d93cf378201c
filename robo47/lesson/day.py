"""A day's manifest, `w*/dayN/day.toml`: its tasks, and what the day hands in.

One file that the starter, the checker, the hints, the lab and the report all read.
Whatever is missing, empty or misspelt in it is found here, at loading, and named; a
day whose manifest is broken costs that day alone.
"""

import re
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path

from robo47.errors import Robo47Error
from robo47.lesson import entries
from robo47.lesson.entries import Entries
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
        optional: a side quest: nothing that a day hands in or a grade counts.
    """

    id: str
    title: str
    functions: tuple[str, ...]
    needs: tuple[str, ...]
    read: str
    hints: tuple[str, ...]
    optional: bool = False


@dataclass(frozen=True)
class Metric:
    """A row that the log must hold, and the range of its value; None is no bound."""

    check: str
    metric: str
    max: float | None = None
    min: float | None = None

    @property
    def limit(self) -> str:
        """The range as people write it: "under 1e-08"."""
        parts = [] if self.min is None else [f"over {self.min:g}"]
        parts += [] if self.max is None else [f"under {self.max:g}"]
        return " and ".join(parts)

    def passes(self, value: float) -> bool:
        """Return whether a value is within the range; NaN never is."""
        high = self.max is None or value < self.max
        return value == value and high and (self.min is None or value > self.min)


@dataclass(frozen=True)
class Day:
    """One day of the course; paths are relative to the week's folder.

    Attributes:
        number: of the day, from 1 to 47.
        title: what it is about.
        see: what its lab shows, for the week's table.
        script: file name of the lab script, in `src/` and in `work/`.
        guide: the lab guide.
        minutes: how long it takes.
        readings: what to read and watch.
        library: modules of `robo47` that are this day's answers; student code of later
            days may import them.
        limit: what an error must be under where no metric says more.
        tasks: in the order to do them.
        figure: the student's picture, "" where the day has none.
        kit_figures: pictures of the kit's own that do not count as the student's.
        worksheet: the student's worksheet, "" where the day has none.
        terms: what the worksheet's glossary defines.
        drawings: how many drawings it holds.
        questions: how many questions it asks.
        metrics: rows of the log.
        folder: the week's folder.
    """

    number: int
    title: str
    see: str
    script: str
    guide: str
    minutes: int
    readings: tuple[str, ...]
    library: tuple[str, ...]
    limit: float
    tasks: tuple[Task, ...]
    figure: str
    kit_figures: tuple[str, ...]
    worksheet: str
    terms: tuple[str, ...]
    drawings: int
    questions: int
    metrics: tuple[Metric, ...]
    folder: Path = field(repr=False)

    @property
    def source(self) -> Path:
        """The complete script."""
        return self.folder / "src" / self.script

    @property
    def work(self) -> Path:
        """The student's script."""
        return self.folder / "work" / self.script

    @property
    def own(self) -> Path:
        """The day's own folder: questions.py, submissions/ and so on."""
        return self.folder / f"day{self.number}"

    @cached_property
    def _needs(self) -> dict[str, tuple[str, ...]]:
        closed: dict[str, set[str]] = {}
        for task in self.tasks:  # needs are earlier tasks, so they are closed already
            closed[task.id] = set(task.needs).union(*(closed[n] for n in task.needs))
        order = [task.id for task in self.tasks]
        return {
            id: tuple(n for n in order if n in found) for id, found in closed.items()
        }

    def needs(self, task_id: str) -> tuple[str, ...]:
        """Return the ids of the tasks that a task builds on, however indirectly."""
        return self._needs[task_id]

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

    def metric(self, check: str, metric: str = "") -> Metric:
        """Return what a recorded number must reach.

        Args:
            check: its name.
            metric: of which there may be several to a check; "" where there is one.

        Raises:
            Robo47Error: the manifest has no such row, or several.
        """
        found = [m for m in self.metrics if m.check == check]
        found = [m for m in found if metric in ("", m.metric)]
        if len(found) != 1:
            rows = ", ".join(f"{m.check} ({m.metric})" for m in self.metrics)
            wanted = f"{check} ({metric})" if metric else check
            raise Robo47Error(
                f"day {self.number}'s day.toml has {len(found)} metrics {wanted}; "
                f"it has {rows}"
            )
        return found[0]


def day_numbers(root: Path = ROOT) -> list[int]:
    """Return the numbers of all days that have a manifest, in order.

    Args:
        root: the clone; its manifests are `w*/dayN/day.toml`.
    """
    return sorted(_manifests(root))


def all_days(root: Path = ROOT) -> list[Day]:
    """Return every day of the course, in order.

    Raises:
        Robo47Error: a manifest is not right.
    """
    return [load_day(path) for _, path in sorted(_manifests(root).items())]


def find_day(number: int, root: Path = ROOT) -> Day:
    """Return a day, from whichever week has it.

    Args:
        number: of the day.
        root: the clone.

    Raises:
        Robo47Error: no week has that day, or its manifest is not right.
    """
    manifests = _manifests(root)
    if number not in manifests:
        known = ", ".join(str(n) for n in sorted(manifests)) or "none"
        raise Robo47Error(f"there is no day {number} yet; the kit has: {known}")
    return load_day(manifests[number])


def started_day(root: Path = ROOT) -> int:
    """Return the latest day that the student has a script of, else the first."""
    numbers = day_numbers(root)
    started = [n for n in numbers if any(root.glob(f"w*/work/day{n}_*.py"))]
    return max(started, default=min(numbers, default=1))


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


def load_day(manifest: Path) -> Day:
    """Return the day of a manifest.

    Args:
        manifest: path of a `day.toml`.

    Raises:
        Robo47Error: it cannot be read, or an entry is missing, empty, of a wrong type
            or unknown; says which.
    """
    top = entries.read(manifest)
    number = top.get("number", int)
    if manifest.parent.name != f"day{number}":
        raise top.refuse(
            f"number is {number}, but the folder is {manifest.parent.name}"
        )
    tasks = tuple(_task(table, number) for table in top.tables("tasks", at_least=1))
    _check_order(tasks, top)
    figure = top.inner("figure") or Entries({}, "")
    worksheet = top.inner("worksheet") or Entries({}, "")
    day = Day(
        number=number,
        title=top.get("title", str),
        see=top.get("see", str),
        script=top.get("script", str),
        guide=top.get("guide", str),
        minutes=top.get("minutes", int),
        readings=top.texts("readings", at_least=0),
        library=top.texts("library", at_least=0),
        limit=float(top.maybe("limit", float, 1e-8)),
        tasks=tasks,
        figure=figure.get("path", str) if figure.table else "",
        kit_figures=figure.texts("not_a_copy_of", at_least=0),
        worksheet=worksheet.get("path", str) if worksheet.table else "",
        terms=worksheet.texts("terms", at_least=0),
        drawings=worksheet.maybe("drawings", int, 0),
        questions=worksheet.maybe("questions", int, 0),
        metrics=tuple(_metric(row) for row in top.tables("metrics")),
        folder=manifest.parent.parent,
    )
    for table in (figure, worksheet, top):
        table.finish()
    return day


def _manifests(root: Path) -> dict[int, Path]:
    found: dict[int, Path] = {}
    for path in sorted(root.glob("w*/day*/day.toml")):
        if number := re.fullmatch(r"day(\d+)", path.parent.name):
            other = found.setdefault(int(number[1]), path)
            if other != path:
                raise Robo47Error(
                    f"two days {number[1]}: {shown(other)}, {shown(path)}"
                )
    return found


def _metric(row: Entries) -> Metric:
    low, high = row.maybe("min", float), row.maybe("max", float)
    if low is None and high is None:
        raise row.refuse("it has neither max nor min")
    metric = Metric(row.get("check", str), row.get("metric", str), high, low)
    row.finish()
    return metric


def _task(table: Entries, day: int) -> Task:
    task = Task(
        id=table.get("id", str),
        title=table.get("title", str),
        functions=table.texts("functions"),
        needs=table.texts("needs", at_least=0),
        read=table.get("read", str),
        hints=table.texts("hints", at_least=2),
        optional=table.maybe("optional", bool, False),
    )
    table.finish()
    if not re.fullmatch(rf"{day}\.\d+", task.id):
        raise table.refuse(f"id {task.id} is not one of day {day}")
    return task


def _check_order(tasks: tuple[Task, ...], top: Entries) -> None:
    """Refuse an id or a function that is there twice, and a need that is no earlier."""
    earlier: set[str] = set()
    functions: set[str] = set()
    for task in tasks:
        if task.id in earlier:
            raise top.refuse(f"two tasks have the id {task.id}")
        for need in task.needs:
            if need not in earlier:
                raise top.refuse(f"{task.id} needs {need}, which is no earlier task")
        if twice := functions & set(task.functions):
            raise top.refuse(f"{task.id}: another task has {min(twice)} already")
        earlier.add(task.id)
        functions |= set(task.functions)
