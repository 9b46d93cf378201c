"""A day's manifest, `w*/dayN/day.toml`: its tasks, and what the day hands in.

One file that the starter, the checker, the hints, the lab and the report all read.
Whatever is missing, empty or misspelt in it is found here, at loading, and named; a
day whose manifest is broken costs that day alone. A field of `Day`, `Task` or `Metric`
is an entry of the file, and is read by its type (`week.py`).
"""

import importlib
import re
import sys
import traceback
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from itertools import cycle
from pathlib import Path
from types import ModuleType
from typing import Any

from labkit.lesson.last_day import started_day
from labkit.lesson.metric import Metric
from labkit.lesson.week import (
    WORK,
    Week,
    entry,
    find_week,
    load,
    load_week,
    manifests,
)
from robo47.errors import Robo47Error
from robo47.paths import ROOT, shown

LOG = "metrics/metrics.csv"  # the path from the top of a clone
NUMBERS = 100_000  # the limit of one answer, unless a task sets another; a pose has 16
# A grader's machine gives a task at most this, whatever its manifest asks for.
MOST = {"seconds": 60.0, "memory": 4.0, "numbers": 1_000_000}
MOST_LAB = 90.0  # the limit of a lab's run, seconds


@dataclass(frozen=True)
class Limits:
    """The limits of a day's file."""

    # The limit of all calls of a task, if the task has its own.
    seconds: Mapping[str, float] = field(default_factory=dict)
    memory: float = 1.0  # GB, of the process
    numbers: int = NUMBERS  # the limit of one answer
    extras: tuple[str, ...] = ()  # packages that it may import, pinned: "scipy==1.17.1"


@dataclass(frozen=True)
class Task:
    """One gap of the starter."""

    id: str  # day.task, such as "1.4"; the same in code, output and worksheet
    title: str
    functions: tuple[str, ...]  # the functions that the student writes
    read: str  # the section to re-read
    # The hints, in the order in which they are given.
    hints: tuple[str, ...] = entry(least=2)
    needs: tuple[str, ...] = ()  # ids of the tasks that its functions may call
    optional: bool = False  # a side quest: no part of what is handed in or graded
    # Ids and names of functions that it had before; the names in the order of the
    # functions, also where only one has another name.
    was: tuple[str, ...] = ()
    # The limit for all its calls; one call may take a third of it.
    seconds: float = 10.0
    memory: float = 1.0  # GB
    numbers: int = NUMBERS  # the limit of one answer

    @property
    def renamed(self) -> list[tuple[str, str]]:
        """Functions that had another name: that, and the one they have.

        Names are in the order of the functions; after the last one the older names
        of the first follow.
        """
        names = [name for name in self.was if name.isidentifier()]
        return list(zip(names, cycle(self.functions), strict=False))


@dataclass(frozen=True, kw_only=True)
class Day:
    """One day of the course; paths are relative to the week's folder."""

    number: int  # a number between 1 and 47
    title: str
    see: str  # "method: what its lab shows with it", for the tables of days
    script: str  # file name of the lab script, in src/ and in work/
    guide: str  # the lab guide
    minutes: int  # the time that the day takes
    was: tuple[str, ...] = ()  # file names that the lab script had before
    # Modules of robo47 that are its answers; later days may import them.
    library: tuple[str, ...] = ()
    limit: float = 1e-8  # the limit of an error unless a metric has its own
    tasks: tuple[Task, ...]  # the tasks, in the order in which they are done
    # The student's picture, "" where there is none; pictures that do not count as it.
    figure: str = entry("", at="figure.path", needed=True)
    # `make figures` draws this one of FIGURES with the functions of the student's file;
    # "" asks for a picture of the arm alone.
    draw: str = entry("", at="figure.draw")
    kit_figures: tuple[str, ...] = entry((), at="figure.not_a_copy_of")
    # The student's worksheet, "" where there is none; what its glossary defines.
    worksheet: str = entry("", at="worksheet.path", needed=True)
    terms: tuple[str, ...] = entry((), at="worksheet.terms")
    # The number of drawings in the worksheet.
    drawings: int = entry(0, at="worksheet.drawings")
    # The number of questions in the worksheet.
    questions: int = entry(0, at="worksheet.questions")
    metrics: tuple[Metric, ...] = ()  # rows of the log
    # The processor time of the lab's run with a student's functions.
    lab_seconds: float = entry(30.0, at="limits.lab_seconds")
    folder: Path = field(repr=False)  # the week's; no entry

    @property
    def method(self) -> str:
        """The method that it teaches, the first part of `see`."""
        return self.see.partition(": ")[0]

    @property
    def result(self) -> str:
        """What its lab shows with the method, the second part of `see`."""
        return self.see.partition(": ")[2]

    @property
    def source(self) -> Path:
        """The complete script."""
        return self.folder / "src" / self.script

    @property
    def work(self) -> Path:
        """The student's script."""
        return self.folder / WORK / self.script

    @property
    def notebook(self) -> Path:
        """The student's notebook, a view of the script."""
        return self.folder / WORK / f"day{self.number}.ipynb"

    @property
    def own(self) -> Path:
        """The day's own folder: its functions' files, submissions/ and so on."""
        return self.folder / f"day{self.number}"

    def named_as(self, is_there: Callable[[str], bool]) -> "Day":
        """Return the day, under a name that its script had where only that is there."""
        before = [replace(self, script=name, was=()) for name in self.was]
        some = (day for day in (self, *before) if is_there(day.files["script"]))
        return next(some, self)

    @property
    def week(self) -> Week:
        """The week that it belongs to."""
        return load_week(self.folder)

    @property
    def limits(self) -> Limits:
        """The limits of the code of its tasks."""
        return Limits(
            {task.id: task.seconds for task in self.tasks},
            max(task.memory for task in self.tasks),
            max(task.numbers for task in self.tasks),
            self.week.extras,
        )

    @property
    def files(self) -> dict[str, str]:
        """The paths of its hand-in from the clone's top, by their kind."""
        week = self.folder.name
        found = {
            "script": f"{week}/{WORK}/{self.script}",
            "worksheet": self.worksheet and f"{week}/{self.worksheet}",
            "figure": self.figure and f"{week}/{self.figure}",
            "log": self.metrics and LOG,
        }
        return {what: path for what, path in found.items() if path}

    def needs(self, task_id: str) -> tuple[str, ...]:
        """Return the ids of the tasks that a task builds on, however indirectly."""
        found = {task_id}
        for task in reversed(self.tasks):  # needs are earlier tasks
            found.update(task.needs if task.id in found else ())
        return tuple(task.id for task in self.tasks if task.id in found - {task_id})

    def task(self, task_id: str) -> Task:
        """Return a task by its id.

        Raises:
            Robo47Error: the day has no such task; names those it has.
        """
        before = [task for task in self.tasks if task_id in task.was]
        for task in [task for task in self.tasks if task.id == task_id] or before:
            return task
        known = ", ".join(task.id for task in self.tasks)
        raise Robo47Error(f"day {self.number} has no task {task_id}; it has {known}")

    def has(self, name: str) -> bool:
        """Return whether its folder brings "inspector", say: a file or a folder."""
        return (self.own / f"{name}.py").is_file() or (self.own / name).is_dir()

    def module(self, name: str) -> ModuleType:
        """Return a file of its folder, imported by path: the machine names no day.

        `w1-foundations/dayN/pd_gains.py` becomes the module `lesson_dayN.pd_gains`;
        files of one day import each other as `from .mistakes import ...`.

        Raises:
            Robo47Error: it has no such file, or that stops while it is loaded.
        """
        file = self.own / f"{name}.py"
        if not self.has(name):
            raise Robo47Error(f"{shown(file)} is not there")
        package = f"lesson_day{self.number}"
        known = sys.modules.get(package)
        if known is None or list(known.__path__) != [str(self.own)]:
            for module in [m for m in sys.modules if m.partition(".")[0] == package]:
                del sys.modules[module]
            sys.modules[package] = ModuleType(package)
            sys.modules[package].__path__ = [str(self.own)]
        try:
            return importlib.import_module(f"{package}.{name}")
        except ModuleNotFoundError:  # a package that a picture or a page needs
            raise
        except Exception as error:
            last = traceback.extract_tb(error.__traceback__)[-1]
            where = f" ({Path(last.filename).name}, line {last.lineno})"
            where = "" if isinstance(error, SyntaxError) else where  # it says so itself
            why = f"{type(error).__name__}: {error}{where}"
            raise Robo47Error(f"{shown(file)} does not load: {why}") from error

    def offered(self, name: str, lab: Path | None = None) -> dict[str, Any]:
        """Return what its figures, films or clips.py offers: {"dayN_name": function}.

        Args:
            name: "figures", for FIGURES; {} where it has no such file.
            lab: the script that the file imports from; by default the kit's.
        """
        if not self.has(name):
            return {}
        if (source := str((lab or self.source).parent)) not in sys.path:
            sys.path.insert(0, source)
        found = getattr(self.module(name), name.upper(), None)
        if not isinstance(found, dict):
            file = shown(self.own / f"{name}.py")
            raise Robo47Error(f"{file} has no {name.upper()}: {{name: function}}")
        return {f"day{self.number}_{key}": made for key, made in found.items()}

    def name_of(self, metric: Metric) -> str:
        """Return what to call a number: its check, and its metric if it has several."""
        alone = [m.check for m in self.metrics].count(metric.check) < 2
        return metric.check if alone else f"{metric.check} {metric.metric}"

    def metric(self, check: str, metric: str = "") -> Metric:
        """Return what a recorded number must reach.

        Args:
            check: its name.
            metric: of which there may be several to a check; "" where there is one.
        """
        found = [m for m in self.metrics if m.check == check]
        found = [m for m in found if metric in ("", m.metric)]
        if len(found) != 1:
            rows = ", ".join(f"{m.check} ({m.metric})" for m in self.metrics)
            wanted = f"{check} ({metric})" if metric else check
            which = "several [[metrics]] called" if found else "no [[metrics]] called"
            raise Robo47Error(
                f"day {self.number}'s day.toml has {which} {wanted}; it has {rows}"
            )
        return found[0]


def day_numbers(root: Path = ROOT) -> list[int]:
    """Return the numbers of all days that have a manifest, in order."""
    return list(manifests(root))


def all_days(root: Path = ROOT) -> list[Day]:
    """Return every day of the course, in order."""
    return [load_day(path) for path in manifests(root).values()]


def days_before(day: Day) -> list[Day]:
    """Return the earlier days of the course, in order."""
    return [load_day(path) for n, path in manifests().items() if n < day.number]


def days_of(week: Week) -> list[Day]:
    """Return the days of a week, in order."""
    return [load_day(path) for path in week.manifests.values()]


def find_day(number: int, root: Path = ROOT) -> Day:
    """Return a day, from whichever week of a clone has it.

    Raises:
        Robo47Error: no week has that day, or its manifest is not right.
    """
    there = manifests(root)
    if number not in there:
        known = ", ".join(map(str, there)) or "none"
        raise Robo47Error(f"there is no day {number} yet; the kit has: {known}")
    return load_day(there[number])


def chosen_day(number: int | None, task_id: str | None = None) -> Day:
    """Return the day that a command line means.

    Args:
        number: of the day; None where none was typed: the task's, or that worked on
            last.
        task_id: such as "1.4", or None.
    """
    if not task_id:
        return find_day(started_day() if number is None else number)
    day, _ = find_task(task_id)
    if number not in (None, day.number):
        raise Robo47Error(
            f"task {task_id} is of day {day.number}, not of day {number}: "
            "name one of the two"
        )
    return day


def chosen_week(number: int | None, day: int | None = None) -> Week:
    """Return the week that a command line means.

    Args:
        number: of the week; None where none was typed: that of the day.
        day: its number; None where none was typed: the day worked on last.

    Raises:
        Robo47Error: there is no such week or day, the week has no days yet, or the
            day is of another week.
    """
    if number is None:
        return chosen_day(day).week
    week = find_week(number)
    if not week.days:
        raise Robo47Error(f"week {number} has no day yet that is written")
    if day is not None and day not in week.days:
        other = find_day(day).week.number
        raise Robo47Error(
            f"day {day} is of week {other}, not of week {number}: name one of the two"
        )
    return week


def day_of(script: Path) -> Day:
    """Return the day whose lab a script is, by its name: dayN_name.py."""
    found = re.match(r"day(\d+)_", script.name)
    if not found:
        raise Robo47Error(f"{script.name} is no lab; expected a name like dayN_*.py")
    return find_day(int(found[1]))


def find_task(task_id: str) -> tuple[Day, Task]:
    """Return the task of an id such as "1.4", and its day."""
    number = task_id.partition(".")[0]
    if not number.isdecimal():
        raise Robo47Error(f"{task_id!r} is no task; expected an id such as 1.4")
    day = find_day(int(number))
    return day, day.task(task_id)


def load_day(manifest: Path) -> Day:
    """Return the day of a `day.toml`.

    Raises:
        Robo47Error: it cannot be read, or an entry is missing, empty, of a wrong type
            or unknown; says which.
    """
    day: Day = load(Day, manifest, folder=manifest.parent.parent)
    for fault in _faults(day, manifest.parent.name):
        raise Robo47Error(shown(manifest) + fault)
    return day


def _faults(day: Day, folder: str) -> Iterator[str]:
    """Say what is wrong between entries that are right by themselves."""
    if folder != f"day{day.number}":
        yield f": number is {day.number}, but the folder is {folder}"
    for i, metric in enumerate(day.metrics, 1):
        if metric.min is None and metric.max is None:
            yield f", metrics {i}: it has neither max nor min"
    if not 0 < day.lab_seconds <= MOST_LAB:
        asked = f"limits, lab_seconds is {day.lab_seconds:g}"
        yield f", {asked}; a grader gives {MOST_LAB:.0f} at most"
    earlier: set[str] = set()
    functions: set[str] = set()
    for task in day.tasks:
        id = task.id
        if not re.fullmatch(rf"{day.number}\.\d+", id):
            yield f", tasks {id}: id {id} is not one of day {day.number}"
        for name, most in MOST.items():
            if not 0 < getattr(task, name) <= most:
                asked = f"{name} is {getattr(task, name)}"
                yield f", tasks {id}: {asked}; a grader gives {most:,.0f} at most"
        if id in earlier:
            yield f": two tasks have the id {id}"
        for need in [n for n in task.needs if n not in earlier]:
            yield f": {id} needs {need}, which is no earlier task"
        if twice := functions & set(task.functions):
            yield f": {id}: another task has {min(twice)} already"
        earlier.add(id)
        functions |= set(task.functions)
