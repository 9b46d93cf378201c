"""A day's manifest, `w*/dayN/day.toml`: its tasks, and what the day hands in.

One file that the starter, the checker, the hints, the lab and the report all read.
Whatever is missing, empty or misspelt in it is found here, at loading, and named; a
day whose manifest is broken costs that day alone.
"""

import re
from functools import lru_cache
from pathlib import Path

from labkit.lesson import entries
from labkit.lesson.content import Day, Metric, Task
from labkit.lesson.entries import Entries
from robo47.errors import Robo47Error
from robo47.paths import ROOT, shown


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
    stat = manifest.stat() if manifest.is_file() else None
    return _load(manifest, stat and (stat.st_mtime_ns, stat.st_size))


@lru_cache(64)  # one command asks for the same manifests many times
def _load(manifest: Path, _state: tuple[int, int] | None) -> Day:
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
