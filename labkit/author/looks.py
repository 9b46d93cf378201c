"""What an author's files must hold, said with file and line before anything runs."""

import re
from collections.abc import Iterator
from importlib.util import find_spec

import numpy as np

from labkit.author.sheet import worksheet_of
from labkit.base.exchange import Exchange, Question
from labkit.handin.worksheet import split_sections
from labkit.judge.answers import InTurn
from labkit.judge.ask import stacked
from labkit.judge.row import rows_of
from labkit.lesson.day import Day
from labkit.lesson.script import find_regions, read_script
from robo47.errors import Robo47Error
from robo47.paths import shown


def faults(day: Day) -> Iterator[str]:
    """Yield what is missing or does not fit between a day's files, with its remedy."""
    yield from _regions(day)
    yield from _functions(day)
    yield from _guide(day)
    yield from _worksheet(day)
    yield from _pictures(day)
    yield from _tabs(day)


def _regions(day: Day) -> Iterator[str]:
    manifest, source = shown(day.own / "day.toml"), shown(day.source)
    wanted = {(task.id, name) for task in day.tasks for name in task.functions}
    regions = find_regions(read_script(day.source), source)
    found = {(region.task, region.function): region.start + 1 for region in regions}
    for task, name in sorted(wanted - set(found)):
        yield (
            f"{source}: no region {task} in {name}, which {manifest} asks for. Put "
            f"`# region {task}` and `# endregion {task}` around its body"
        )
    for task, name in sorted(set(found) - wanted):
        yield (
            f"{source}, line {found[task, name]}: region {task} in {name}, which "
            f"{manifest} does not know. Add it to the functions of task {task}"
        )


def _functions(day: Day) -> Iterator[str]:
    for name, row in rows_of(day).items():
        if not callable(getattr(row.lab, name, None)):
            yield f"{shown(day.source)}: no function {name}"
            continue
        calls, file = row.ask.inputs, f"{shown(day.own)}/{name}.py"
        first = next(iter(calls(np.random.default_rng(0))))
        if len(first) != len(row.arguments):
            yield (
                f"{file}: @row.inputs yields {len(first)} arguments; "
                f"{name} takes {len(row.arguments)}: {', '.join(row.arguments)}"
            )
        elif isinstance(row.ask.truth, InTurn):  # which says what does not fit
            row.ask.truth(*stacked([Exchange(Question("", name, tuple(first)))]))


def _guide(day: Day) -> Iterator[str]:
    path = day.folder / day.guide
    if not path.is_file():
        yield f"{shown(path)} is not there; it is the guide"
        return
    headings = re.findall(r"^#+ (.+)$", path.read_text("utf-8"), re.MULTILINE)
    for task in day.tasks:
        section = task.read.partition(";")[0].removeprefix("Lab guide, ")
        if section not in headings:
            yield (
                f"{shown(day.own / 'day.toml')}, task {task.id}: {shown(path)} has no "
                f"heading {section!r}; it has {', '.join(map(repr, headings[1:]))}"
            )


def _worksheet(day: Day) -> Iterator[str]:
    """Yield the sections that a worksheet lacks; write one where there is none."""
    if not day.worksheet:
        return
    path = day.folder / day.worksheet
    if not path.is_file():
        path.write_text(worksheet_of(day), "utf-8", newline="\n")
        yield f"{shown(path)} was not there: written from day.toml, yours to fill in"
        return
    there = split_sections(path.read_text("utf-8"))
    for name in split_sections(worksheet_of(day)):
        asked = [one for one in there if one.startswith(name.partition(":")[0])]
        if name and name != "predictions" and not asked:
            yield f"{shown(path)}: no section {name!r}, which day.toml asks for"


def _pictures(day: Day) -> Iterator[str]:
    file = day.own / "figures.py"
    if day.draw and f'"{day.draw}"' not in (file.read_text() if file.is_file() else ""):
        yield f"{shown(file)}: FIGURES has no {day.draw!r}, which day.toml draws"


def _tabs(day: Day) -> Iterator[str]:
    """Yield why the day's tabs do not load; nothing where viser is not installed."""
    if day.has("inspector") and find_spec("viser"):
        from labkit.inspector.tab import day_tabs

        try:
            day_tabs(day)
        except Robo47Error as error:
            yield str(error)
