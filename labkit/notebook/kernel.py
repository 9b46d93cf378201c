"""Functions for the cells of a notebook: check, hint, run, predict, answer, load.

    from labkit.notebook.kernel import begin, check
    begin(2)
    check("2.1")

The cells that were executed are read from IPython, so a cell counts as soon as it ran.
A user's mistake is one line, never a traceback of the kit's.
"""

import ast
import contextlib
import functools
import inspect
import os
import re
import secrets
import shutil
import subprocess
import sys
import tempfile
import traceback
from collections.abc import Callable, Iterator
from pathlib import Path
from types import EllipsisType
from typing import Any, ParamSpec, TypeVar

from labkit.base import store
from labkit.lesson.backup import with_ends_of
from labkit.lesson.cells import definitions, reverted, split_script, text_of
from labkit.lesson.day import Day, find_day
from labkit.lesson.hidden_numbers import WORD
from labkit.lesson.lab_module import read_script
from labkit.lesson.predictions import rows_asked
from labkit.notebook import sync, worksheet
from labkit.notebook.guide import with_notebook_commands
from labkit.notebook.show import CheckResult, Message
from robo47.errors import Robo47Error
from robo47.paths import ROOT, shown

P = ParamSpec("P")
R = TypeVar("R")
ANSWERS = "answers.json"  # the entries of worksheets, in the kit's store
_STEP = r"^{}\. .*?(?=^\d+\. |^\n|\Z)"  # a step of a lab's output
_TRACEBACK = r"^Traceback \(most.*?^(?=\w[\w.]*: )"  # a traceback without its last line
_KINDS = {str: "text in quotation marks", int: "a whole number"}
_now: list[Day] = []  # the day that was begun last
_brought = [0]  # the number of executed cells that were last in step with the file


def polite(example: str) -> Callable[[Callable[P, R]], Callable[P, R | Message]]:
    """Return a decorator of a function whose errors for users become one line.

    Args:
        example: a right call; "{task}" stands for a task of the day.
    """

    def decorate(function: Callable[P, R]) -> Callable[P, R | Message]:
        @functools.wraps(function)
        def asked(*args: P.args, **given: P.kwargs) -> R | Message:
            if fault := _misuse(function, args, given):
                task = _now[0].tasks[0].id if _now else "1.1"
                right = example.format(task=task)
                return Message(
                    [f"{function.__name__}: {fault}; write, for example, {right}"]
                )
            try:
                return function(*args, **given)
            except (Robo47Error, NotImplementedError) as error:
                return Message([str(error)])

        return asked

    return decorate


def _misuse(function: Callable[..., Any], args: Any, given: Any) -> str:
    """Return what is wrong with the arguments of a call, "" if nothing is."""
    signature = inspect.signature(function)
    try:
        bound = signature.bind(*args, **given).arguments
    except TypeError as error:
        return str(error)
    for name, value in bound.items():
        kind = signature.parameters[name].annotation
        wrong = not isinstance(value, kind) if kind in _KINDS else False
        if wrong or (kind is int and isinstance(value, bool)):
            return f"{name} is {_KINDS[kind]}, and this is {value!r}"
    return ""


@polite("begin(1)")
def begin(number: int) -> Message:
    """Begin a day: write its file if there is none, and make its modules importable.

    Args:
        number: of the day.
    """
    day = find_day(number)
    _now[:] = [day]
    os.chdir(ROOT)  # a line such as "!git status" runs where the guide expects it
    _draw_without_display()
    said = _script("start_day.py", str(number))
    there = day.work.is_file()
    return Message(said.splitlines()[: 1 if there else None])


def _draw_without_display() -> None:
    """Choose how MuJoCo draws, before it is imported; only pictures need it."""
    from labkit.figures import backends

    try:
        backends.rendering_environment()
    except Robo47Error:
        os.environ.setdefault("MUJOCO_GL", "disable")


@polite('check("{task}")')
def check(task: str = "", *, keep: str = "") -> CheckResult:
    """Check one task, or the whole day, with the cells that you have run.

    Args:
        task: such as "2.1"; "" is the whole day.
        keep: "notebook" or "file": which text counts if both were edited; "notebook"
            also takes a cell's text that is older than the file's.
    """
    from labkit.check.once import check_once

    if keep not in ("", "notebook", "file"):
        raise Robo47Error(f'keep is "notebook" or "file", and this is {keep!r}')
    day = _day()
    told = _bring(day, keep)
    wanted = day.task(task).id if task else None
    found = check_once(day, day.work, wanted, secrets.randbits(32))
    return CheckResult(found, told, hint)


@polite('hint("{task}")')
def hint(task: str = "") -> Message:
    """Show the next hint for a task, or for the first one that does not pass."""
    _bring(_day())
    told = _script("hint.py", *([task] if task else []), "--day", str(_day().number))
    return Message([told])


@polite("run(step=1)")
def run(step: int = 0, *, reveal: bool = False, **constants: Any) -> Message | None:
    """Run the lab with your functions, or show one step of it.

    Args:
        step: its number; 0 runs all steps and records your numbers.
        reveal: show the numbers that you have not predicted yet; nothing is recorded.
        constants: other values for constants of the lab, such as `TRIALS=10`; nothing
            is judged or recorded then.
    """
    day = _day()
    known = _steps(read_script(day.work))
    if step and step not in known:
        steps = ", ".join(map(str, known))
        raise Robo47Error(f"the lab has no step {step}; it has {steps}")
    _bring(day)
    if constants:
        printed = _tried(day, constants)
    elif step or reveal:
        sheet = _sheet(day)[1]
        more = ("--reveal",) if reveal or _tells_nothing(day, step, sheet) else ()
        printed = _unlogged(day, day.work.read_bytes(), sheet, more)
    else:
        printed = _script("run_day.py", str(day.number))
    print(with_notebook_commands(_step_output(printed, step) if step else printed))
    return None


def _tells_nothing(day: Day, step: int, sheet: str) -> bool:
    """Return whether a step prints no number that is still to be predicted.

    A lab that stops early hides every number, because any of them may be one that it
    measures later. The complete lab does not stop, so its output shows where they are.
    """
    if all(rows_asked(sheet).values()):
        return False
    found = re.search(_STEP.format(step), _complete(day, sheet), re.DOTALL | re.M)
    return found is not None and WORD not in found.group()


@functools.lru_cache(maxsize=4)
def _complete(day: Day, sheet: str) -> str:
    """Return what the complete lab prints without the numbers to be predicted."""
    options = ["--no-log", "--predict-first"]
    return _printed([sys.executable, str(day.source), *options])


def _steps(lab: str) -> list[int]:
    """Return the numbers of the steps of a lab, in order."""
    return sorted({int(n) for n in re.findall(r"\.step\(\s*f?[\"'](\d+)\. ", lab)})


def _step_output(printed: str, step: int) -> str:
    """Return what a lab prints in a step, or why it did not come so far."""
    flags = re.MULTILINE | re.DOTALL
    if found := re.search(_STEP.format(step), printed, flags):
        hidden = WORD in found.group() and printed.startswith("Predict first")
        why = printed.partition("\nrobot: ")[0] + "\n\n" if hidden else ""
        return f"{why}{found.group().strip()}"
    last = [at.start() for at in re.finditer(r"^\d+\. ", printed, flags)]
    said = printed[last[-1] :] if last else printed
    return f"The lab stopped before step {step}. Its last lines are:\n\n{said}"


@polite('predict("the row\'s name", 0.5)')
def predict(number: str, value: object) -> Message:
    """Write a prediction into the worksheet, before you see the number.

    Args:
        number: the first cell of its row.
        value: your prediction; a number or words.
    """
    words = "" if value is None or isinstance(value, EllipsisType) else str(value)
    if not words.strip():
        return Message(
            [f"Write your prediction of {number!r} in place of the three dots."]
        )
    if "|" in words or len(words.splitlines()) > 1:
        raise Robo47Error("a prediction is one line without the character |")
    path, sheet = _sheet(_day())
    _rewrite(path, worksheet.with_prediction(sheet, number, words.strip()))
    return Message([f"Your prediction is in {shown(path)}."])


@polite('answer("question 1", "your words")')
def answer(place: str, words: str) -> Message:
    """Write an answer into the worksheet.

    Args:
        place: its name, as in the cell that the notebook came with.
        words: your answer, in Markdown.
    """
    if not words.strip():
        return Message([f"Write your answer to {place!r} between the quotation marks."])
    day = _day()
    path, sheet = _sheet(day)
    memory = store.read(ANSWERS)
    key = f"{day.number} {place}"
    sheet = worksheet.with_answer(sheet, place, words, memory.get(key, ""))
    _rewrite(path, sheet)
    store.write(ANSWERS, memory | {key: words})
    return Message([f"Your answer is in {shown(path)}."])


@polite('load("the name of a function")')
def load(name: str) -> Message:
    """Put the text of a function, as the day's file has it, into a new cell.

    Args:
        name: of the function.
    """
    script, own = split_script(read_script(_day().work))
    text = own.get(name) or text_of(script, name)
    if not text:
        raise Robo47Error(f"{shown(_day().work)} has no function {name}")
    _shell().set_next_input(text)
    return Message(["The cell below has the text of the file. Run it, and it counts."])


@polite('picture("its name")')
def picture(name: str) -> Any:
    """Draw a picture of the day's lesson with your functions.

    Args:
        name: as in the file of the lesson's picture, without its ending.
    """
    from labkit.figures.lessons import lesson_figures

    day = _day()
    _bring(day)
    with _own_modules(day):
        try:
            figures = lesson_figures(day.number, own=True)
            if name in figures:
                return figures[name]()
        except Exception as error:
            raise Robo47Error(_own_fault(day, error)) from None
    names = ", ".join(figures) or "none"
    raise Robo47Error(f"the day has no picture {name!r}; it has {names}")


@contextlib.contextmanager
def _own_modules(day: Day) -> Iterator[None]:
    """Let the day's pictures import the student's file as it is now, and forget it."""
    path, writes = list(sys.path), sys.dont_write_bytecode
    _forget(day)
    sys.path.insert(0, str(day.work.parent))
    sys.dont_write_bytecode = True  # two edits within a second have one time
    try:
        yield
    finally:
        sys.path[:], sys.dont_write_bytecode = path, writes
        _forget(day)


def _forget(day: Day) -> None:
    """Forget the modules that hold the functions of the student's file."""
    names = (Path(day.script).stem, f"lesson_day{day.number}.figures")
    for module in [
        m for m in sys.modules if m in names or m.startswith(names[1] + ".")
    ]:
        del sys.modules[module]


def _own_fault(day: Day, error: Exception) -> str:
    """Return in one line what went wrong in a student's function.

    Raises:
        Exception: the error itself, if no line of the student's file is in it.
    """
    cause = error.__cause__ or error  # a file of pictures that did not load
    own = [
        frame
        for frame in traceback.extract_tb(cause.__traceback__)
        if Path(frame.filename) == day.work
    ]
    if not own:
        raise error
    if isinstance(cause, NotImplementedError):
        return f"this picture needs a function that is still to do; {cause}"
    where = f"{own[-1].name}, `{own[-1].line}`"
    return f"your {where}: {type(cause).__name__}: {cause}"


@polite("figure()")
def figure() -> Any:
    """Draw the picture that the day hands in, with your functions, and write it."""
    from PIL import Image

    day = _day()
    _bring(day)
    number = str(day.number)
    if day.draw:
        print(_script("make_figures.py", "--day", number))
    else:
        print(_script("view_panda.py", number, "--screenshot"))
    path = day.folder / day.figure
    return Image.open(path) if path.is_file() else None


def _day() -> Day:
    if not _now:
        raise Robo47Error("run the first cell of the notebook: it begins the day")
    return _now[0]


def _shell() -> Any:
    """Return IPython, which the cells run in; None outside of a notebook."""
    loaded = sys.modules.get("IPython")  # a kernel has loaded it
    return loaded.get_ipython() if loaded else None


def _bring(day: Day, keep: str = "") -> list[str]:
    """Put the executed cells into the day's file; return what is to be told of it."""
    sources = _executed()
    cells = definitions(sources)
    told = sync.bring(day, cells, keep, reverted(sources, _brought[0])).sentences(day)
    _brought[0] = len(sources)
    return [*told, *(f"The cell of {n}, {at}." for n, at in cells.broken.items())]


def _executed() -> list[str]:
    """Return the texts of the cells that were executed in this kernel, in order."""
    shell = _shell()
    return list(shell.history_manager.input_hist_raw) if shell else []


@functools.lru_cache(maxsize=4)
def _unlogged(day: Day, lab: bytes, sheet: str, more: tuple[str, ...]) -> str:
    """Run the lab; return what it prints, once for each text of lab and worksheet."""
    return _script("run_day.py", str(day.number), "--no-log", *more)


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
        printed = _printed([sys.executable, str(copy), "--try"])
    return re.sub(_TRACEBACK, "", printed, flags=re.MULTILINE | re.DOTALL)


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


def _rewrite(path: Path, text: str) -> None:
    """Write a file of the student's, with the line ends that it has."""
    store.replace(path, with_ends_of(path.read_bytes(), text))
