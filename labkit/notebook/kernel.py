"""What the cells of a day's notebook call: check, hint, run, predict, answer, load.

    from labkit.notebook.kernel import begin, check
    begin(2)
    check("2.1")

The cells that were executed are read from IPython, so a cell counts as soon as it ran.
A user's mistake is one line, never a traceback of the kit's.
"""

import ast
import functools
import os
import re
import secrets
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path
from types import EllipsisType
from typing import Any, ParamSpec, TypeVar

from labkit.base import store
from labkit.lesson.cells import Cells, apart, definitions, text_of
from labkit.lesson.day import Day, find_day
from labkit.lesson.lab_module import read_script
from labkit.notebook import sync, worksheet
from labkit.notebook.show import Checked, Said
from robo47.errors import Robo47Error
from robo47.paths import ROOT, shown

P = ParamSpec("P")
R = TypeVar("R")
ANSWERS = "answers.json"  # in the kit's memory: what was written into worksheets
_STEP = r"^{}\. .*?(?=^\d+\. |^\n|\Z)"  # of a lab's output
_now: list[Day] = []  # the day that was begun last


def polite(function: Callable[P, R]) -> Callable[P, R | Said]:
    """Return a function whose errors for users become one line."""

    @functools.wraps(function)
    def asked(*args: P.args, **given: P.kwargs) -> R | Said:
        try:
            return function(*args, **given)
        except (Robo47Error, NotImplementedError) as error:
            return Said([str(error)])

    return asked


@polite
def begin(number: int) -> Said:
    """Begin a day: write its file if there is none, and make its modules importable.

    Args:
        number: of the day.
    """
    day = find_day(number)
    _now[:] = [day]
    _draw_without_display()
    said = _script("start_day.py", str(number))
    there = day.work.is_file()
    return Said(said.splitlines()[: 1 if there else None])


def _draw_without_display() -> None:
    """Choose how MuJoCo draws, before it is imported; only pictures need it."""
    from labkit.figures import backends

    try:
        backends.rendering_environment()
    except Robo47Error:
        os.environ.setdefault("MUJOCO_GL", "disable")


@polite
def check(task: str = "", *, keep: str = "") -> Checked:
    """Check one task, or the whole day, with the cells that you have run.

    Args:
        task: such as "2.1"; "" is the whole day.
        keep: "notebook" or "file": which text counts if both were edited.
    """
    from labkit.check.once import check_once

    day = _day()
    told = sync.bring(day, _executed(), keep).told(day)
    wanted = day.task(task).id if task else None
    found = check_once(day, day.work, wanted, secrets.randbits(32))
    return Checked(found, told, hint)


@polite
def hint(task: str = "") -> Said:
    """Show the next hint for a task, or for the first one that does not pass."""
    sync.bring(_day(), _executed())
    told = _script("hint.py", *([task] if task else []), "--day", str(_day().number))
    return Said(told.splitlines())


@polite
def run(step: int = 0, **constants: Any) -> Said | None:
    """Run the lab with your functions, or show one step of it.

    Args:
        step: its number; 0 runs all steps and records your numbers.
        constants: other values for constants of the lab, such as `TRIALS=10`; nothing
            is judged or recorded then.
    """
    day = _day()
    sync.bring(day, _executed())
    if constants:
        printed = _tried(day, constants)
    elif step:
        printed = _unlogged(day, day.work.read_bytes(), _sheet(day)[1])
    else:
        printed = _script("run_day.py", str(day.number))
    if not step:
        print(printed)
        return None
    found = re.search(_STEP.format(step), printed, re.MULTILINE | re.DOTALL)
    print(found.group() if found else printed)
    return None


@polite
def predict(number: str, value: object) -> Said:
    """Write a prediction into the worksheet, before you see the number.

    Args:
        number: the first cell of its row.
        value: your prediction; a number or words.
    """
    if isinstance(value, EllipsisType):
        return Said(
            [f"Write your prediction of {number!r} in place of the three dots."]
        )
    day = _day()
    path, sheet = _sheet(day)
    store.replace(path, worksheet.with_prediction(sheet, number, str(value)).encode())
    return Said([f"Your prediction is in {shown(path)}."])


@polite
def answer(place: str, words: str) -> Said:
    """Write an answer into the worksheet.

    Args:
        place: its name, as in the cell that the notebook came with.
        words: your answer, in Markdown.
    """
    if not words.strip():
        return Said([f"Write your answer to {place!r} between the quotation marks."])
    day = _day()
    path, sheet = _sheet(day)
    memory = store.read(ANSWERS)
    key = f"{day.number} {place}"
    sheet = worksheet.with_answer(sheet, place, words, memory.get(key, ""))
    store.replace(path, sheet.encode())
    store.write(ANSWERS, memory | {key: words})
    return Said([f"Your answer is in {shown(path)}."])


@polite
def load(name: str) -> Said:
    """Put the text of a function, as the day's file has it, into a new cell.

    Args:
        name: of the function.
    """
    script, own = apart(read_script(_day().work))
    text = own.get(name) or text_of(script, name)
    if not text:
        raise Robo47Error(f"{shown(_day().work)} has no function {name}")
    _shell().set_next_input(text)
    return Said(["The cell below has the text of the file. Run it, and it counts."])


@polite
def picture(name: str) -> Any:
    """Draw a picture of the day's lesson with your functions.

    Args:
        name: as in the file of the lesson's picture, without its ending.
    """
    from labkit.figures.lessons import lesson_figures

    day = _day()
    sync.bring(day, _executed())
    return lesson_figures(day.number, own=True)[name]()


@polite
def figure() -> Any:
    """Draw the picture that the day hands in, with your functions, and write it."""
    from PIL import Image

    day = _day()
    sync.bring(day, _executed())
    print(_script("make_figures.py", "--day", str(day.number)))
    path = day.folder / day.figure
    return Image.open(path) if path.is_file() else None


def _day() -> Day:
    if not _now:
        raise Robo47Error("run the first cell of the notebook: it begins the day")
    return _now[0]


def _shell() -> Any:
    """Return IPython, which the cells run in."""
    from IPython.core.getipython import get_ipython

    return get_ipython()


def _executed() -> Cells:
    """Return what the cells define that were executed, the last one of each name."""
    shell = _shell()
    return definitions(shell.history_manager.input_hist_raw if shell else [])


@functools.lru_cache(maxsize=4)
def _unlogged(day: Day, lab: bytes, sheet: str) -> str:
    """Run the lab; return what it prints, once for each text of lab and worksheet."""
    return _script("run_day.py", str(day.number), "--no-log")


def _script(name: str, *arguments: str) -> str:
    """Run a script of the kit; return what it prints."""
    return _printed([sys.executable, str(ROOT / "scripts" / name), *arguments])


def _printed(command: list[str]) -> str:
    """Run a command; return what it prints, with its complaints."""
    pipe, merged = subprocess.PIPE, subprocess.STDOUT
    done = subprocess.run(command, stdout=pipe, stderr=merged, text=True, check=False)
    return done.stdout.strip()


def _tried(day: Day, constants: dict[str, Any]) -> str:
    """Run a copy of the day's file with other constants; return what it prints."""
    text = with_constants(read_script(day.work), constants)
    with tempfile.TemporaryDirectory(prefix="robo47-try-") as folder:
        for path in day.work.parent.glob("*.py"):
            shutil.copy(path, folder)
        copy = Path(folder, day.script)
        copy.write_text(text, "utf-8")
        return _printed([sys.executable, str(copy), "--try"])


def with_constants(script: str, constants: dict[str, Any]) -> str:
    """Return a script with other values for some of its constants.

    Args:
        script: the text of a lab.
        constants: values by name; a new one stands directly below the old one, so that
            what is derived from it follows.

    Raises:
        Robo47Error: the script has no such constant.
    """
    lines = script.splitlines()
    ends: dict[str, int] = {}
    for node in ast.parse(script).body:
        for one in ast.walk(node) if isinstance(node, ast.Assign) else ():
            if isinstance(one, ast.Name) and isinstance(one.ctx, ast.Store):
                ends[one.id] = node.end_lineno or 0
    if unknown := set(constants) - set(ends):
        raise Robo47Error(f"the lab has no constant {min(unknown)}")
    for name in sorted(constants, key=lambda name: -ends[name]):
        value = constants[name]
        array = hasattr(value, "tolist")
        text = f"np.array({value.tolist()!r})" if array else repr(value)
        lines.insert(ends[name], f"{name} = {text}")
    return "\n".join(lines) + "\n"


def _sheet(day: Day) -> tuple[Path, str]:
    """Return where the day's worksheet is, and its text."""
    path = day.folder / day.worksheet
    try:
        return path, path.read_text("utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise Robo47Error(f"{shown(path)} cannot be read: {error}") from None
