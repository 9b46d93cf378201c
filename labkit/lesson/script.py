"""A day's lab script as text and as a module: its starter, and what a file shows.

The complete script in `src/` is the only source. A task's lines stand between
`# region 1.4` and `# endregion 1.4`, below the docstring of the function they belong
to; a task may own several regions. The starter keeps everything else, and each gap
raises, naming its task: a placeholder such as the identity is a legal pose.
"""

import ast
import difflib
import re
from collections.abc import Iterable
from dataclasses import dataclass, replace
from functools import cache, lru_cache
from itertools import chain
from pathlib import Path
from types import CodeType, ModuleType

from labkit.lesson.day import Day, Task
from labkit.lesson.marks import Writers, marks_of
from labkit.lesson.sealed import opened
from robo47.errors import Robo47Error
from robo47.paths import shown

_MARKER = re.compile(r"^(?P<indent>\s*)# (?P<end>end)?region\b\s*(?P<task>\S*)\s*$")
_DEF = re.compile(r"^def (?P<name>\w+)\(")
BORROWED = "# borrowed from the kit"  # in a function that is not the student's own


@dataclass(frozen=True)
class Region:
    """One stretch of a solution."""

    task: str  # its id, such as "1.4"
    function: str  # the function it stands in
    start: int  # index of the marker's line, counted from 0
    end: int  # index of the end marker's line
    indent: str  # the white space before the marker


def find_regions(text: str, name: str) -> list[Region]:
    """Return the regions of a complete script, in order.

    Raises:
        Robo47Error: a region that is nested, unclosed, closed without being open,
            closed under another name, without an id, or outside a function.
    """
    regions: list[Region] = []
    function, opened = "", None
    for number, line in enumerate(text.splitlines()):
        definition, marker = _DEF.match(line), _MARKER.match(line)
        if definition and opened:
            why = f"region {opened.task} is still open at the next function"
        else:
            why = _misplaced(marker, function, opened) if marker else ""
        if why:
            raise Robo47Error(f"{name}, line {number + 1}: {why}")
        if definition:
            function = definition["name"]
        elif marker and opened:
            regions.append(replace(opened, end=number))
            opened = None
        elif marker:
            opened = Region(marker["task"], function, number, -1, marker["indent"])
    if opened:
        why = f"region {opened.task} is never closed"
        raise Robo47Error(f"{name}, line {opened.start + 1}: {why}")
    return regions


def _misplaced(marker: re.Match[str], function: str, opened: Region | None) -> str:
    """Return why a marker may not stand in a function or region that is open, or ""."""
    task = marker["task"]
    if not task:
        return "a region marker without the id of its task"
    if not marker["end"]:
        if opened:
            return f"region {task} opens inside region {opened.task}"
        inside = marker["indent"] and function
        return "" if inside else f"region {task} is not inside a function"
    if not opened:
        return f"endregion {task}, but no region is open"
    closes = f"endregion {task} closes region {opened.task}"
    return "" if opened.task == task else closes


def make_starter(text: str, name: str, day: int) -> str:
    """Return the script with each region replaced by a TODO and a raise.

    Args:
        text: the complete script.
        name: what to call it in an error.
        day: number of the day, for the commands in the first lines.
    """
    lines = text.splitlines()
    for region in reversed(find_regions(text, name)):
        size = region.end - region.start - 1
        about = f"about {size} line{'s' if size > 1 else ''}"
        lines[region.start : region.end + 1] = [
            f"{region.indent}# TODO {region.task}: {about}. Stuck? make hint "
            f"TASK={region.task}",
            f"{region.indent}raise NotImplementedError("
            f'"task {region.task}: write {region.function}")',
        ]
    head = [
        "# Yours to complete: write the body of each TODO. How it stands:",
        f"#     make check DAY={day}        (add ARGS=--watch to check at every save)",
    ]
    return "\n".join(head + lines) + "\n"


def starter_of(day: Day) -> str:
    """Return the starter of a day's lab."""
    return make_starter(read_script(day.source), shown(day.source), day.number)


def solution(text: str, name: str, task: str) -> str:
    """Return the complete functions that a task asks for, without markers."""
    wanted = [r.function for r in find_regions(text, name) if r.task == task]
    bodies = ["\n".join(function_lines(text, function)[2]) for function in wanted]
    kept = [ln for ln in "\n\n".join(bodies).splitlines() if not _MARKER.match(ln)]
    return "\n".join(kept)


def function_lines(text: str, function: str) -> tuple[int, int, list[str]]:
    """Return where a top-level function stands, even in a file that does not parse.

    Returns:
        First line's index, index past the last, and the lines; (-1, -1, []) if absent.
    """
    lines = text.splitlines()
    for start, line in enumerate(lines):
        found = _DEF.match(line)
        if not found or found["name"] != function:
            continue
        end = start + 1
        # Indented, blank, or the closing bracket of a signature of several lines.
        while end < len(lines) and re.match(r"\s|$|\)", lines[end]):
            end += 1
        while not lines[end - 1].strip():
            end -= 1
        return start, end, lines[start:end]
    return -1, -1, []


def put_back(text: str, starter: str, functions: tuple[str, ...]) -> str:
    """Return a student's script with some functions as the starter has them.

    One that is gone is put above `main`.
    """
    for function in functions:
        gap = function_lines(starter, function)[2]
        start, end, _ = function_lines(text, function)
        lines = text.splitlines()
        if start < 0:
            start = end = max(function_lines(text, "main")[0], 0) or len(lines)
            gap = [*gap, "", ""]
        lines[start:end] = gap
        text = "\n".join(lines) + "\n"
    return text


def borrowed_tasks(day: Day, text: str) -> list[Task]:
    """Return the tasks of which a student's file borrows a function."""
    if BORROWED not in text:
        return []

    def borrows(function: str) -> bool:
        return BORROWED in "\n".join(function_lines(text, function)[2])

    return [task for task in day.tasks if any(map(borrows, task.functions))]


def writers_of(day: Day, script: bytes | None = None) -> Writers:
    """Return the files that may have written a day's rows in a student's log.

    Args:
        day: from its manifest.
        script: the student's; by default as it is now, b"" where there is none.
    """
    kits = day.source.read_bytes() if day.source.is_file() else None
    if script is None:
        script = day.work.read_bytes() if day.work.is_file() else b""
    borrowed = borrowed_tasks(day, script.decode("utf-8", "replace"))
    # No script has no mark: that of an empty one would make a row somebody's.
    marks = marks_of(kits or None), marks_of(script or None)
    return Writers(*marks, [task.id for task in borrowed])


def read_script(path: Path) -> str:
    """Return a script's text in UTF-8, of a sealed one the complete lab's."""
    try:
        return opened(path.read_text("utf-8-sig"))
    except FileNotFoundError:
        raise Robo47Error(f"{shown(path)} is not there") from None
    except UnicodeDecodeError:
        raise Robo47Error(f"{shown(path)} is not in UTF-8: save it as such") from None
    except OSError as error:
        raise Robo47Error(f"{shown(path)} cannot be read: {error.strerror}") from None


@cache
def lab_of(day: Day) -> ModuleType:
    """Return a day's complete lab as a module, one for all who ask; see `load_lab`."""
    return load_lab(day.source)


def load_lab(script: Path) -> ModuleType:
    """Return a lab script as a module of its own, in the kit's Python: this one."""
    module = ModuleType(script.stem)
    module.__file__ = str(script)
    exec(_code(read_script(script), str(script)), vars(module))
    return module


@lru_cache(maxsize=16)
def _code(text: str, name: str) -> CodeType:
    return compile(without_kit(text), name, "exec")


def without_kit(text: str) -> str:
    """Return a lab's text without its first import, which leads to the kit's Python."""
    return text.replace("\nimport kit ", "\n# ")


def arguments(source: str, function: str) -> tuple[str, ...]:
    """Return the names of a function's arguments; () where it is not in the file."""
    found = _functions(source).get(function)
    return tuple(arg.arg for arg in found.args.args) if found else ()


def unfinished(source: str, function: str) -> str:
    """Return what keeps a function from doing anything yet, in a sentence, or ""."""
    found = _functions(source).get(function)
    body = found.body if found else []
    first = body[0] if body else None
    if isinstance(first, ast.Expr) and isinstance(first.value, ast.Constant):
        body = body[1:]  # the docstring
    gaps = [node for node in body if _is_gap(node)]
    if gaps and len(gaps) < len(body):
        return (
            f"Your code is there, but line {gaps[0].lineno}, "
            "`raise NotImplementedError(...)`, still stops it: delete that line."
        )
    if body and all(isinstance(node, ast.Pass) for node in body):
        return "Its body is `pass`, which does nothing: write what it should return."
    return ""


def renamed(source: str, function: str) -> str:
    """Return what to do about a missing function that has another name, or ""."""
    there = {name.lower(): found for name, found in _functions(source).items()}
    for near in difflib.get_close_matches(function.lower(), there, 1, cutoff=0.8):
        return (
            f"The file has no function {function}, but {there[near].name} (line "
            f"{there[near].lineno}): did you mean {function}? Give it that name again."
        )
    return ""


def kits_functions(day: Day, tasks: Iterable[Task]) -> str:
    """Return code that puts functions of the complete lab below a file.

    The whole lab comes with it, so nothing that is answered then may pass.

    Args:
        day: whose complete lab it is; "" is returned where it is not there.
        tasks: whose functions.
    """
    names = [name for task in tasks for name in task.functions]
    if not names or not day.source.is_file():
        return ""
    text = without_kit(read_script(day.source))
    lines = [f"_kits = {{'__name__': 'kits_lab'}}; exec({text!r}, _kits)"]
    lines += [f"{name} = _kits[{name!r}]" for name in names]
    return "\n\n" + "\n".join(lines) + "\n"


def kits_own(day: Day, tasks: Iterable[Task]) -> str:
    """Return code that puts the functions below a file that it borrows.

    No other function of the kit comes with them: the file's own could call it and pass.

    Args:
        day: whose complete lab has them; "" is returned where it is not there.
        tasks: that the file borrows.
    """
    names = [name for task in tasks for name in task.functions]
    if not names or not day.source.is_file():
        return ""
    text = read_script(day.source)
    own = "\n".join(chain.from_iterable(function_lines(text, n)[2] for n in names))
    return f"\n\nexec({own!r}, globals())\n"


def old_names(day: Day, text: str) -> str:
    """Return code that gives functions the names that the manifest has for them now.

    Args:
        day: from its manifest.
        text: a student's file, begun with an older one.
    """
    there = set(re.findall(r"^def (\w+)\(", text, re.MULTILINE))
    names = [pair for task in day.tasks for pair in task.renamed]
    lines = [
        f"{now} = {was}" for was, now in names if was in there and now not in there
    ]
    return "\n\n" + "\n".join(lines) + "\n" if lines else ""


@lru_cache(8)  # a check asks for all functions of a file
def _functions(source: str) -> dict[str, ast.FunctionDef]:
    """Return the functions at the top of a file; {} where it cannot be read."""
    try:
        found = ast.parse(source.removeprefix("\ufeff")).body
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return {}
    return {node.name: node for node in found if isinstance(node, ast.FunctionDef)}


def _is_gap(node: ast.stmt) -> bool:
    names = (n.id for n in ast.walk(node) if isinstance(n, ast.Name))  # no recursion
    return isinstance(node, ast.Raise) and "NotImplementedError" in names


def is_kits(day: Day) -> bool:
    """Return whether `require_kits` lets a day's script in `src/` pass."""
    try:
        require_kits(day)
    except Robo47Error:
        return False
    return True


def require_kits(day: Day) -> None:
    """Refuse a script in `src/` that lacks the marks of a task of the manifest.

    The public course's own script has the same name and is saved over ours; what then
    runs is neither.
    """
    wanted = {(task.id, f) for task in day.tasks for f in task.functions}
    source = shown(day.source)
    text = ""
    fault = ""
    try:
        text = read_script(day.source)
        wanted -= {(r.task, r.function) for r in find_regions(text, source)}
        if wanted:
            fault = "{} has no region {} in {}".format(source, *min(wanted))
    except Robo47Error as error:  # gone, in another encoding, or with broken markers
        fault = str(error)
    if fault and "# region" in text:
        author = f"Do you write this day? make author DAY={day.number}"
        raise Robo47Error(f"{fault}. {author}. Else: make doctor")
    if fault:
        raise Robo47Error(
            f"{source} is not the kit's: the marks of its tasks are gone. "
            f"Yours belongs in {shown(day.work.parent)}/; to get the kit's back: "
            f"git checkout -- {source}"
        )
