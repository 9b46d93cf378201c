"""A day's notebook, made of its guide, its starter and its manifest.

For each task: its section of the guide, a cell with the starter's function, a cell that
checks it. Where the guide prints a step of the lab, a cell runs that step, below the
predictions that belong to it. The worksheet's questions are cells at the end.
"""

import ast
import json
import posixpath
import re
import tomllib
from collections.abc import Iterable, Iterator
from typing import Any

from labkit.lesson.cells import text_of
from labkit.lesson.day import Day, Task
from labkit.lesson.lab_module import read_script
from labkit.lesson.predictions import rows_asked
from labkit.lesson.sealed import is_sealed
from labkit.lesson.starter import find_regions, starter_of
from labkit.notebook import guide, worksheet
from robo47.errors import Robo47Error
from robo47.paths import shown

Cell = dict[str, Any]

KERNEL = {"display_name": "Python 3", "language": "python", "name": "python3"}
SETUP = """\
# Run this cell first. Outside of a clone it gets the kit and installs it.
import importlib
import subprocess
import sys
from pathlib import Path

REPOSITORY = "{repository}"  # the address that you would give to git clone
FOLDER = "robo47"  # on Colab, a folder in your Drive keeps your work

if importlib.util.find_spec("labkit") is None:
    kit = Path(FOLDER).resolve()
    if not kit.exists():
        assert REPOSITORY, "write the address of the course into REPOSITORY"
        clone = ["git", "clone", "--quiet", "--depth=1", REPOSITORY, str(kit)]
        subprocess.run(clone, check=True)
    pip = [sys.executable, "-m", "pip", "install", "--quiet", "--editable"]
    subprocess.run([*pip, f"{{kit}}[figures]"], check=True)
    fetch = [sys.executable, "scripts/fetch_menagerie.py"]
    subprocess.run(fetch, cwd=kit, check=True)
    sys.path.insert(0, str(kit))
    importlib.invalidate_caches()

from labkit.notebook.kernel import answer, begin, check, figure, hint, load
from labkit.notebook.kernel import picture, predict, run

begin({day})"""
HEAD = """\
*This is the guide of Day {day} with cells for your code. `check` also writes your
functions into `{work}`, the file that all other commands read.*"""
COMMANDS = """\
- `check("{task}")` checks one task, and `check()` the whole day.
- `hint("{task}")` prints the next hint for a task.
- `run(step=1)` runs one step of the lab with your functions; `run()` runs all of it and
  records your numbers.
- `run(step=1, NAME=value)` gives a constant of the lab another value for this run, and
  `run(step=1, reveal=True)` shows the numbers that you have not predicted yet.
- A line that begins with `!`, such as `!git status`, is a command of the terminal. It
  runs in the folder of the course."""


def build(
    day: Day, *, complete: bool = False, fresh: bool = False, repository: str = ""
) -> str:
    """Return a day's notebook as the text of its file.

    Args:
        day: from its manifest.
        complete: with the kit's own functions in place of the student's.
        fresh: with empty functions, also where the student has begun the day.
        repository: the address of the course, for a notebook that is opened elsewhere.

    Raises:
        Robo47Error: an edition has no answers; or notebook.toml is wrong.
    """
    source, functions = _texts(day, complete, fresh)
    cells = list(_cells(day, source, functions, repository, complete))
    for i, cell in enumerate(cells):
        cell["id"] = f"cell-{i:03}"
    made = {
        "cells": cells,
        "metadata": {"kernelspec": KERNEL, "language_info": {"name": "python"}},
        "nbformat": 4,
        "nbformat_minor": 5,
    }
    return json.dumps(made, indent=1, ensure_ascii=False) + "\n"


def text(words: str) -> Cell:
    """Return a cell of text."""
    return {"cell_type": "markdown", "metadata": {}, "source": words.strip()}


def code(source: str, **marks: str) -> Cell:
    """Return a cell of code; `marks` say whose function it is."""
    return {
        "cell_type": "code",
        "metadata": {"robo47": marks} if marks else {},
        "source": source.strip(),
        "execution_count": None,
        "outputs": [],
    }


def _cells(
    day: Day, source: str, functions: str, repository: str, complete: bool
) -> Iterator[Cell]:
    """Yield the cells, from the title to the worksheet.

    A complete notebook asks nothing: it has no predictions and no questions, and the
    functions are checked once.
    """
    blocks = guide.blocks_of(guide.guide_of(day))
    base = _base(day, repository)
    tasks: dict[int, list[Task]] = {}
    for task in day.tasks:
        tasks.setdefault(guide.place_of(task, blocks), []).append(task)
    first = day.tasks[0].id
    about = HEAD.format(day=day.number, work=shown(day.work))
    yield text(f"{blocks[0].text}\n\n{about}")
    yield code(SETUP.format(day=day.number, repository=repository))
    yield code(_head(source))
    yield text(COMMANDS.format(task=first))
    steps = Steps(day, source, asks=not complete)
    words: list[str] = []
    for i, block in enumerate(blocks[1:], 1):
        own = list(steps.cells(block.step)) if block.step else []
        if block.heading and block.section.startswith("Answers to"):
            own = list(steps.rest())
            own += [] if complete else [*steps.tried(), *_worksheet(day)]
        if words and (own or block.heading == 2):
            yield text(guide.linked("\n\n".join(words), base))
            words = []
        yield from own
        if not block.step:
            words.append(guide.plain(block))
        if guide.asks_all(block) and steps.open:
            yield text(guide.linked("\n\n".join(words), base))
            words = []
            yield from steps.asked()
        if i in tasks:
            yield text(guide.linked("\n\n".join(words), base))
            words = []
            for task in tasks[i]:
                yield from _task(task, functions, checked=not complete)
    if words:
        yield text(guide.linked("\n\n".join(words), base))


def _texts(day: Day, complete: bool, fresh: bool) -> tuple[str, str]:
    """Return the complete lab, and the text that the functions are taken from."""
    if complete and is_sealed(day.source.read_text("utf-8")):
        raise Robo47Error("this edition of the kit has no complete labs")
    source = read_script(day.source)
    if complete:
        regions = find_regions(source, shown(day.source))
        marks = {line for region in regions for line in (region.start, region.end)}
        lines = source.splitlines()
        return source, "\n".join(ln for i, ln in enumerate(lines) if i not in marks)
    own = day.work.is_file() and not fresh
    return source, read_script(day.work) if own else starter_of(day)


def _head(source: str) -> str:
    """Return the lab's imports and constants, which the functions use."""
    lines = source.splitlines()
    body = ast.parse(source).body
    first = next(node for node in body if isinstance(node, ast.FunctionDef))
    before = [node for node in body if node.lineno < first.lineno][1:]  # no docstring
    kept = [node for node in before if not ast.unparse(node).startswith("import kit")]
    start = kept[0].lineno - 1
    skipped = {n.lineno - 1 for n in before if n not in kept}
    numbered = enumerate(lines[start : first.lineno - 1], start)
    return "\n".join(line for i, line in numbered if i not in skipped)


def _base(day: Day, repository: str) -> str:
    """Return where relative links of the guide begin, seen from a notebook."""
    address = repository.removesuffix(".git")
    if not address.startswith("https://github.com/"):
        return f"../{posixpath.dirname(day.guide)}/"
    raw = address.replace("https://github.com/", "https://raw.githubusercontent.com/")
    return f"{raw}/HEAD/{day.folder.name}/docs/"


def _task(task: Task, functions: str, checked: bool) -> Iterator[Cell]:
    """Yield a cell for each function of a task, and one that checks them."""
    for name in task.functions:
        written = guide.with_notebook_commands(text_of(functions, name))
        yield code(written, task=task.id, function=name)
    if checked:
        yield code(f'check("{task.id}")')


class Steps:
    """The steps of a day's lab, with their predictions and pictures."""

    def __init__(self, day: Day, source: str, asks: bool) -> None:
        """Find out which predictions belong to which step; `asks` for any at all."""
        self.day = day
        self.more = extras(day)
        sheet = _sheet(day)
        self.open = list(rows_asked(sheet)) if asks else []
        self.at = numbers_by_step(source, self.open)
        self.first = True

    def asked(self) -> Iterator[Cell]:
        """Yield all predictions that no step has had yet, where the guide asks so."""
        for name in self.open:
            yield code(f"predict({name!r}, ...)")
        self.open = []

    def cells(self, step: int) -> Iterator[Cell]:
        """Yield the predictions of a step, the run, and what the day adds."""
        rows = [n for n in self.open if self.at.get(n) == step]
        if self.first:  # those that belong to no step come before any number
            rows += [name for name in self.open if name not in self.at]
        self.first = False
        for name in rows:
            yield code(f"predict({name!r}, ...)")
        yield code(f"run(step={step})")
        yield from self.more.pop(str(step), [])

    def rest(self) -> Iterator[Cell]:
        """Yield the check and the run of the whole lab."""
        yield text("## Check and run the whole lab\n\n`run()` records your numbers.")
        yield code("check()")
        yield code("run()")

    def tried(self) -> Iterator[Cell]:
        """Yield what the day adds at its end, and the picture to hand in."""
        for step in sorted(self.more):
            yield from self.more[step]
        if self.day.figure:
            drawn = "drawn with your functions" if self.day.draw else "of the arm"
            yield text(f"The picture to hand in, {drawn}:")
            yield code("figure()")


def numbers_by_step(source: str, names: Iterable[str]) -> dict[str, int]:
    """Return in which step of a lab each predicted number is measured.

    Args:
        source: of the complete lab. The calls `lab.step(...)`, `lab.measured(...)` and
            `lab.predict(...)` are read, in `main` and in the functions that it calls.
        names: of the predicted numbers.
    """
    defined = {
        n.name: n for n in ast.parse(source).body if isinstance(n, ast.FunctionDef)
    }
    found: list[tuple[str, int]] = []
    step = 0
    for kind, pattern in _calls(defined["main"], defined):
        if kind == "step" and pattern[:1].isdigit():
            step = int(pattern.partition("\\.")[0])
        elif kind != "step":
            found.append((pattern, step))
    return {name: s for name in names for text, s in found if re.fullmatch(text, name)}


def _calls(
    function: ast.FunctionDef, defined: dict[str, ast.FunctionDef]
) -> Iterator[tuple[str, str]]:
    """Yield a lab's methods as they are called, each with a pattern of its text."""
    nodes = list(ast.walk(function))
    texts = {
        node.targets[0].id: _pattern(node.value, {})
        for node in nodes
        if isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Name)
    }
    calls = [node for node in nodes if isinstance(node, ast.Call)]
    for call in sorted(calls, key=lambda one: (one.lineno, one.col_offset)):
        match call.func:
            case ast.Attribute(attr="step" | "measured" as kind) if call.args:
                yield kind, _pattern(call.args[0], texts)
            case ast.Attribute(attr="predict" as kind) if len(call.args) == 2:
                yield kind, ", ".join(_pattern(one, texts) for one in call.args)
            case ast.Name(id=name) if name in defined and name != function.name:
                rest = {n: f for n, f in defined.items() if n != function.name}
                yield from _calls(defined[name], rest)


def _pattern(node: ast.expr, texts: dict[str, str]) -> str:
    """Return a regular expression of the texts that an expression may be."""
    match node:
        case ast.Constant(value=str(text)):
            return re.escape(text)
        case ast.JoinedStr(values=parts):
            return "".join(_pattern(part, {}) for part in parts)
        case ast.FormattedValue():
            return ".+"
        case ast.Name(id=name) if name in texts:
            return texts[name]
    return r"(?!)"  # no text that could be read


def extras(day: Day) -> dict[str, list[Cell]]:
    """Return the cells that come after a step: {"1": [...], ..., "end": [...]}."""
    path = day.own / "notebook.toml"
    found: dict[str, list[Cell]] = {}
    if not path.exists():
        return found
    try:
        for cell in tomllib.loads(path.read_text("utf-8"))["cells"]:
            after = found.setdefault(str(cell["after"]), [])
            after.append(text(cell["text"]))
            if lines := cell.get("code"):
                after.append(code(lines))
    except (ValueError, KeyError, TypeError) as error:
        raise Robo47Error(
            f"{shown(path)}: {type(error).__name__}: {error}; expected [[cells]] with "
            "after, text and code"
        ) from None
    return found


def _worksheet(day: Day) -> Iterator[Cell]:
    """Yield the open places of the worksheet, a text and a cell each."""
    if not day.worksheet:
        return
    sheet = _sheet(day)
    where = shown(day.folder / day.worksheet)
    yield text(
        "## The worksheet\n\nWrite between the quotation marks and run the cell: it "
        f"writes your words into `{where}`. Drawings go there as well: link a picture."
    )
    for place in worksheet.places(sheet):
        yield text(f"**{place.name[0].upper()}{place.name[1:]}.** {place.asks}")
        yield code(f'answer({place.name!r}, """\n\n""")')


def _sheet(day: Day) -> str:
    """Return the text of a day's worksheet, "" if the day has none."""
    return (day.folder / day.worksheet).read_text("utf-8") if day.worksheet else ""
